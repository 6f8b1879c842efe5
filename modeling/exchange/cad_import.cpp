#include "modeling/exchange/cad_import.h"

#include <cmath>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/exchange/cad_body.h"
#include "modeling/exchange/cad_read.h"
#include "modeling/exchange/cad_request.h"
#include "modeling/exchange/opencascade_session.h"
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
  const OpenCascadeSession session;
  readInSandbox(path, text, {.options = options}, importSeconds(text, options), job);
  return readCadBody(path, text, options, job);
}

void importCadBodies(const std::filesystem::path& path, std::size_t count,
                     const ImportOptions& options, const TakeBody& take, const Job& job) {
  options.validate();
  job.throwIfCancelled();
  const std::string text = readCadText(path);
  const OpenCascadeSession session;
  const std::vector<std::string> problems =
      readAllInSandbox(path, text, count, options, importSeconds(text, options), job);
  std::size_t next = 0;
  const auto refuseBefore = [&](std::size_t end) {
    for (; next < end; ++next) take(next, {std::nullopt, problems[next]});
  };
  const auto wants = [&](std::size_t index) { return index < count && problems[index].empty(); };
  const auto takeNext = [&](std::size_t index, BodyOutcome outcome) {
    refuseBefore(index);
    take(index, std::move(outcome));
    ++next;
    job.report(Phase::kImport, static_cast<double>(next) / static_cast<double>(count));
  };
  readCadBodies(path, text, options, wants, takeNext, job);
  while (next < count && !problems[next].empty()) refuseBefore(next + 1);
}

FileBodies listCad(const std::filesystem::path& path, ListedSurface surface, const Job& job) {
  job.throwIfCancelled();
  const std::string text = readCadText(path);
  job.report(Phase::kRead, 0.0);
  const double seconds =
      secondsFor(text) + (surface == ListedSurface::kCoarse ? kSecondsForMesh : 0.0);
  const std::string list =
      readInSandbox(path, text, {.lists = true, .surface = surface}, seconds, job);
  job.report(Phase::kRead, 1.0);
  try {
    return fileBodiesFrom(list);
  } catch (const ModelingError& error) {
    throw ModelingError(path.string() + ": " + error.what());
  }
}

}  // namespace palpa::modeling
