#include "app/core/results/accuracy_advice.h"

#include <algorithm>
#include <cmath>

#include "app/core/model/model_memory.h"
#include "app/core/results/finer_mesh.h"
#include "app/core/setup/project_geometry.h"

namespace palpa::app {
namespace {

using Limit = AccuracyAdvice::Limit;
using modeling::MeshSettings;

/// Contacts wider than fingertips by more than this factor limit the accuracy.
constexpr double kWide = 1.05;
/// Lengths are divided by a little more than expected to be necessary.
constexpr double kMargin = 1.05;
/// A mesh with less than this many times the coefficients is not worth a rebuild.
constexpr double kWorthwhile = 1.1;
/// Growth of the time of compressed models with the number of coefficients (docs/performance.md).
constexpr double kCompressedTimePower = 1.4;
constexpr int kTries = 8;  // of sizes that fit the memory

Limit limitOf(const modeling::Project& project, const TouchModel& model, const TouchError& error) {
  if (error.relative <= project.mesh.accuracy) return Limit::kNone;
  if (!model.setup().splines) return error.widening > kWide ? Limit::kTouch : Limit::kEdgeLength;
  if (project.mesh.elementLength) return Limit::kElementLength;
  const ElementSizes sizes = ElementSizes::of(project.mesh, fingertipRadius(project));
  const ProjectGeometry geometry(project);
  if (geometry.refinement().interior > sizes.interior) return Limit::kBuildTime;
  return Limit::kElementSize;
}

/// The usual order without a comparable sample of a former mesh.
double orderOf(const std::optional<AccuracySample>& former, double coefficients,
               const TouchError& error, bool hasSplines) {
  const bool isComparable =
      former && former->error.relative > 0 &&
      (hasSplines || std::max(former->error.widening, error.widening) <= kWide);
  if (!isComparable) return usualOrder(hasSplines);
  return observedOrder(former->error.relative, error.relative,
                       std::sqrt(coefficients / std::max(former->coefficients, 1)), hasSplines);
}

}  // namespace

AccuracyAdvice adviseAccuracy(const modeling::Project& project, const TouchModel& model,
                              const TouchError& error, const std::optional<AccuracySample>& former,
                              const BuildOptions& options, const Job& job) {
  AccuracyAdvice advice;
  advice.requested = project.mesh.accuracy;
  advice.reached = error.relative;
  advice.limit = limitOf(project, model, error);
  advice.usableBytes = usableMemory(options.memoryLimit);
  if (advice.limit == Limit::kNone) return advice;

  const bool hasSplines = advice.hasSplines = model.setup().splines != nullptr;
  const double count = model.setup().discretisation->displacementCount();
  const double slots = model.setup().discretisation->slots().count();
  advice.order = orderOf(former, count, error, hasSplines);
  const double thinShare = bem::sizeOf(*model.setup().discretisation).thinShare;
  const auto bytesOf = [&](double coefficients) {
    return expectedBytes({coefficients, coefficients * slots / count, thinShare},
                         model.setup().engine, options.precision);
  };
  // The narrowest contact that triangles can represent has the same error on all meshes: it falls
  // when contacts are as narrow as a fingertip. Splines represent even their narrowest well.
  const double narrowing = hasSplines ? 1 : error.widening;
  const double needed =
      narrowing *
      std::max(1.0, kMargin * std::pow(error.relative / advice.requested, 1 / advice.order));
  const double before = estimateCoefficients(project, project.mesh, job);
  double factor = needed;
  for (int k = 0; k < kTries; ++k) {
    job.throwIfCancelled();
    const MeshSettings mesh = finerMesh(project.mesh, hasSplines, factor);
    // Estimates have an error that both have in common.
    const double coefficients = estimateCoefficients(project, mesh, job) * count / before;
    const double bytes = bytesOf(coefficients);
    if (k == 0) advice.neededBytes = bytes;
    const bool fits = advice.usableBytes <= 0 || bytes <= advice.usableBytes;
    if (!fits) {
      // Memory grows with the fourth power of the factor.
      const double excess = std::isfinite(bytes) ? bytes / advice.usableBytes : 16;
      factor = std::max(1.0, 0.98 * factor * std::pow(excess, -0.25));
      continue;
    }
    if (coefficients < kWorthwhile * count) return advice;
    advice.mesh = mesh;
    advice.coefficients = coefficients;
    advice.bytes = bytes;
    // Splines stop at the largest density, so measure the factor by the coefficients.
    const double reached = std::max(1.0, std::sqrt(coefficients / count) / narrowing);
    advice.isEnough = k == 0 && mesh.splineDensity < MeshSettings::kMaxSplineDensity;
    advice.expected = advice.isEnough ? advice.requested
                                      : std::max(advice.requested,
                                                 advice.reached * std::pow(reached, -advice.order));
    const BuildReport& report = model.report();
    const double growth = coefficients / count;
    const bool isCompressed = report.storage == "compressed";
    advice.seconds =
        report.assembleSeconds * std::pow(growth, isCompressed ? kCompressedTimePower : 2) +
        report.factoriseSeconds * std::pow(growth, isCompressed ? kCompressedTimePower : 3);
    return advice;
  }
  return advice;
}

}  // namespace palpa::app
