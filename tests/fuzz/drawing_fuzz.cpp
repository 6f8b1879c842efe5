#include <cmath>
#include <cstdint>
#include <string_view>

#include "modeling/error.h"
#include "modeling/exchange/profile_import.h"
#include "modeling/shapes/profile_check.h"
#include "modeling/shapes/profile_sketch.h"
#include "tests/fuzz/require.h"

using namespace palpa;

namespace {

/// The largest path as a profile, as `palpa-cli new` and the window make it.
void fitLargest(const modeling::Drawing& drawing) {
  const double tolerance = 0.01;
  const auto paths = modeling::joinedPaths(drawing.paths, tolerance);
  fuzz::require(!paths.empty(), "no paths after joining");
  const modeling::FittedProfile fitted = modeling::fitProfile(paths.front(), {tolerance, 0.2});
  fuzz::require(std::isfinite(fitted.deviation), "no finite deviation");
  modeling::checkProfileCurve(fitted.curve, "fuzz: profile");
  const modeling::ProfileSketch sketch(fitted.curve);
  fuzz::require(sketch.isCurve(), "no curve in the sketch");
  fuzz::require(!modeling::toSvg(fitted.curve).empty(), "no SVG");
}

}  // namespace

/// Any bytes are refused with a ModelingError that names the source, or they are finite curves that
/// become a profile or are refused with a ModelingError. The first byte chooses the format.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  modeling::Drawing drawing;
  try {
    drawing =
        data[0] % 2 == 1 ? modeling::readSvg(bytes, "fuzz") : modeling::readDxf(bytes, "fuzz");
  } catch (const modeling::ModelingError& error) {
    fuzz::require(std::string_view(error.what()).starts_with("fuzz: "), error.what());
    return 0;
  }
  fuzz::require(!drawing.paths.empty(), "a drawing without paths");
  for (const modeling::DrawnPath& path : drawing.paths)
    for (const modeling::DrawnPiece& piece : path.pieces)
      for (const Eigen::Vector2d& p : piece.points)
        fuzz::require(p.allFinite(), "a point that is not finite");
  try {
    fitLargest(drawing);
  } catch (const modeling::ModelingError&) {
    // A path can be too complicated, or of no length.
  }
  return 0;
}
