#include "modeling/exchange/cad_import.h"

#include <cmath>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/exchange/cad_body.h"
#include "modeling/exchange/cad_read.h"
#include "modeling/exchange/opencascade_session.h"
#include "modeling/exchange/sandboxed_read.h"

namespace palpa::modeling {
namespace {

constexpr double kMinSeconds = 10.0;  // more than any valid file of its size needs
constexpr double kSecondsPerByte = 2e-5;
constexpr double kSecondsForMesh = 300.0;  // in addition if an edge length is given

}  // namespace

void ImportOptions::validate() const {
  const auto check = [](const char* name, double value) {
    if (!std::isfinite(value) || value < 0.0 || value > 1e7)
      throw ModelingError(std::string(name) + ": " + numberText(value) +
                          " mm; expected at most 10 km, or 0 for an automatic choice");
  };
  check("edge_length_mm", edgeLength);
  check("tolerance_mm", tolerance);
}

ImportedBody importCad(const std::filesystem::path& path, const ImportOptions& options,
                       const Job& job) {
  options.validate();
  job.throwIfCancelled();
  const std::string text = readCadText(path);
  const OpenCascadeSession session;
  const double seconds = kMinSeconds + kSecondsPerByte * static_cast<double>(text.size()) +
                         (options.edgeLength > 0.0 ? kSecondsForMesh : 0.0);
  readInSandbox(path, text, options, seconds, job);
  return readCadBody(path, text, options, job);
}

}  // namespace palpa::modeling
