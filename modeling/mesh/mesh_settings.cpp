#include "modeling/mesh/mesh_settings.h"

#include <cmath>

#include "base/text.h"
#include "modeling/error.h"

namespace palpa::modeling {
namespace {

constexpr int kMaxLevels = 6;
constexpr double kMinAccuracy = 1e-4;
constexpr double kMaxAccuracy = 0.1;
constexpr double kMinFactor = 0.05;
constexpr double kMaxFactor = 20.0;

}  // namespace

void MeshSettings::validate(const std::string& path) const {
  if (!std::isfinite(edgeLength) || edgeLength <= 0.0)
    throw ModelingError(path + ".edge_length_mm: " + numberText(edgeLength) +
                        " must be finite and greater than 0");
  if (!(accuracy >= kMinAccuracy && accuracy <= kMaxAccuracy))
    throw ModelingError(path + ".accuracy: " + numberText(accuracy) + " is outside " +
                        numberText(kMinAccuracy) + " … " + numberText(kMaxAccuracy));
  if (!(splineDensity >= 1 && splineDensity <= kMaxSplineDensity))
    throw ModelingError(path + ".spline_density: " + numberText(splineDensity) +
                        " is outside 1 … " + numberText(kMaxSplineDensity));
  if (elementLength && !(std::isfinite(*elementLength) && *elementLength > 0.0))
    throw ModelingError(path + ".element_length_mm: " + numberText(*elementLength) +
                        " must be finite and greater than 0");
  if (refinementLevels < 0 || refinementLevels > kMaxLevels)
    throw ModelingError(path + ".refinement.levels: " + std::to_string(refinementLevels) +
                        " is outside 0 … " + std::to_string(kMaxLevels));
  if (!(featureFraction >= 0.0 && featureFraction <= 1.0))
    throw ModelingError(path + ".feature_fraction: " + numberText(featureFraction) +
                        " is outside 0 … 1");
  for (const auto& [name, factor] : patchFactors) {
    const std::string place = path + ".patch_factors." + name;
    if (!(factor >= kMinFactor && factor <= kMaxFactor))
      throw ModelingError(place + ": " + numberText(factor) + " is outside " +
                          numberText(kMinFactor) + " … " + numberText(kMaxFactor));
  }
}

}  // namespace palpa::modeling
