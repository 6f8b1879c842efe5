#include "app/core/results/accuracy_advice.h"

#include <algorithm>
#include <cmath>

#include "app/core/model/model_memory.h"
#include "app/core/setup/project_geometry.h"
#include "modeling/error.h"
#include "modeling/mesh/mesh.h"
#include "modeling/project/mesh_foci.h"

namespace palpa::app {
namespace {

using Limit = AccuracyAdvice::Limit;
using modeling::MeshSettings;

/// Orders of convergence of the force under a fingertip that the mesh can represent, without an
/// observation. Linear triangles have 2. Splines have up to 6 where they resolve all (bumps, see
/// element_sizes.cpp), about 3 with edges and borders.
constexpr double kTriangleOrder = 2, kSplineOrder = 3;
/// Observed orders outside this range belong to meshes that are too coarse to show one.
constexpr double kMinOrder = 1, kMaxOrder = 6;
/// Contacts wider than fingertips by more than this factor limit the accuracy.
constexpr double kWide = 1.05;
/// Lengths are divided by a little more than expected to be necessary.
constexpr double kMargin = 1.05;
/// A mesh with less than this many times the coefficients is not worth a rebuild.
constexpr double kWorthwhile = 1.1;
constexpr int kTries = 8;  // of sizes that fit the memory

/// Divides all lengths of elements by `factor`.
MeshSettings finer(MeshSettings mesh, bool hasSplines, double factor) {
  // Three digits, so that fields show the number.
  const auto rounded = [](double value, auto round) {
    const double unit = std::pow(10.0, std::floor(std::log10(value)) - 2);
    return round(value / unit) * unit;
  };
  const auto down = [&](double value) {
    return rounded(value, [](double x) { return std::floor(x); });
  };
  if (!hasSplines)
    mesh.edgeLength = down(mesh.edgeLength / factor);
  else if (mesh.elementLength)
    mesh.elementLength = down(*mesh.elementLength / factor);
  else
    mesh.splineDensity =
        std::min(rounded(mesh.splineDensity * factor, [](double x) { return std::ceil(x); }),
                 MeshSettings::kMaxSplineDensity);
  return mesh;
}

/// Coefficients of displacement of a project with other mesh settings, about; infinite if they are
/// impossible.
double coefficientsOf(const modeling::Project& project, const MeshSettings& mesh) {
  modeling::Project other = project;
  other.mesh = mesh;
  try {
    if (usesSplines(other)) return ProjectGeometry(other).refinement().coefficients;
    return modeling::estimateNodeCount(other.body, mesh, modeling::meshRegions(other),
                                       modeling::meshFoci(other));
  } catch (const modeling::ModelingError&) {
    return INFINITY;
  }
}

Limit limitOf(const modeling::Project& project, const TouchModel& model, const TouchError& error) {
  if (error.relative <= project.mesh.accuracy) return Limit::kNone;
  if (!model.setup().splines) return error.widening > kWide ? Limit::kTouch : Limit::kEdgeLength;
  if (project.mesh.elementLength) return Limit::kElementLength;
  const ElementSizes sizes = ElementSizes::of(project.mesh, fingertipRadius(project));
  const ProjectGeometry geometry(project);
  if (geometry.refinement().interior > sizes.interior) return Limit::kBuildTime;
  return Limit::kElementSize;
}

double observedOrder(const AccuracySample& former, const AccuracySample& present, bool hasSplines,
                     double usual) {
  const double refinement =
      std::sqrt(static_cast<double>(present.coefficients) / std::max(former.coefficients, 1));
  const bool isComparable =
      (hasSplines || std::max(former.error.widening, present.error.widening) <= kWide) &&
      std::abs(std::log(refinement)) > 0.05 && former.error.relative > 0;
  if (!isComparable) return usual;
  const double order =
      std::log(former.error.relative / present.error.relative) / std::log(refinement);
  return std::isfinite(order) ? std::clamp(order, kMinOrder, kMaxOrder) : usual;
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
  const double usual = hasSplines ? kSplineOrder : kTriangleOrder;
  advice.order =
      former ? observedOrder(*former, {static_cast<int>(count), error}, hasSplines, usual) : usual;
  const auto bytesOf = [&](double coefficients) {
    return expectedBytes(coefficients, coefficients * slots / count, model.setup().engine,
                         options.precision);
  };
  // The narrowest contact that triangles can represent has the same error on all meshes: it falls
  // when contacts are as narrow as a fingertip. Splines represent even their narrowest well.
  const double narrowing = hasSplines ? 1 : error.widening;
  const double needed =
      narrowing *
      std::max(1.0, kMargin * std::pow(error.relative / advice.requested, 1 / advice.order));
  const double before = coefficientsOf(project, project.mesh);
  double factor = needed;
  for (int k = 0; k < kTries; ++k) {
    job.throwIfCancelled();
    const MeshSettings mesh = finer(project.mesh, hasSplines, factor);
    // Estimates have an error that both have in common.
    const double coefficients = coefficientsOf(project, mesh) * count / before;
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
    advice.seconds = report.assembleSeconds * growth * growth +
                     report.factoriseSeconds * growth * growth * growth;
    return advice;
  }
  return advice;
}

}  // namespace palpa::app
