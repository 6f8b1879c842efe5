#include "modeling/exchange/cad_import.h"

#include <cmath>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/exchange/cad_read.h"
#include "modeling/exchange/sandboxed_read.h"

namespace palpa::modeling {
namespace {

constexpr double kMinSeconds = 10.0;  // more than any valid file of its size needs
constexpr double kSecondsPerByte = 2e-5;
constexpr double kSecondsForMesh = 300.0;  // in addition if the solid, or its picture, is meshed

double secondsFor(const std::string& text) {
  return kMinSeconds + kSecondsPerByte * static_cast<double>(text.size());
}

double importSeconds(const std::string& text, const ImportOptions& options) {
  return secondsFor(text) + (options.edgeLength > 0.0 ? kSecondsForMesh : 0.0);
}

}  // namespace

void ImportOptions::validate() const {
  const auto check = [](const char* name, double value) {
    if (!std::isfinite(value) || value < 0.0 || value > 1e7)
      throw ModelingError(std::string(name) + ": " + numberText(value) +
                          " mm; expected at most 10 km, or 0 for an automatic choice");
  };
  check("edge_length_mm", edgeLength);
  check("tolerance_mm", tolerance);
  placement.validate();
}

ImportedBody importCad(const std::filesystem::path& path, const ImportOptions& options,
                       const Job& job) {
  options.validate();
  job.throwIfCancelled();
  const std::string text = readCadText(path);
  return importInSandbox(path, text, options, importSeconds(text, options), job);
}

void importCadBodies(const std::filesystem::path& path, std::size_t count,
                     const ImportOptions& options, const TakeBody& take, const Job& job) {
  options.validate();
  job.throwIfCancelled();
  const std::string text = readCadText(path);
  std::size_t done = 0;
  const auto takeNext = [&](std::size_t index, BodyOutcome outcome) {
    take(index, std::move(outcome));
    ++done;
    job.report(Phase::kImport, static_cast<double>(done) / static_cast<double>(count));
  };
  importAllInSandbox(path, text, count, options, takeNext, importSeconds(text, options), job);
}

FileBodies listCad(const std::filesystem::path& path, ListedSurface surface, const Job& job) {
  job.throwIfCancelled();
  const std::string text = readCadText(path);
  const double seconds =
      secondsFor(text) + (surface == ListedSurface::kCoarse ? kSecondsForMesh : 0.0);
  return listInSandbox(path, text, surface, seconds, job);
}

}  // namespace palpa::modeling
