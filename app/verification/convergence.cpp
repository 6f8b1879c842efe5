#include "app/verification/convergence.h"

#include <cmath>
#include <map>

#include "app/core/setup/to_spline_surface.h"
#include "app/verification/exact/simple_meshes.h"
#include "app/verification/exact/solved_body.h"
#include "app/verification/spline_body.h"
#include "modeling/shapes/primitives.h"

namespace palpa::verification {
using namespace bem;

namespace {

using Eigen::Vector3d;

constexpr double kRadius = 25;  // mm
const Material kMaterial{0.1, 0.3};

ExactField exactField() {
  return kelvinField({20, 15, 40}, {0.03, -0.02, 0.06}, kMaterial);
}

/// `cells` along each edge of the cube whose faces make the sphere.
ConvergenceStep solveTriangles(int cells, const Job& job) {
  const ExactField exact = exactField();
  const SolvedBody body(
      retagged(sphereMesh(kRadius, cells), 1, isBelow), kMaterial, exact,
      [](int tag) { return tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction; },
      SolvedBody::Options{Precision::kAutomatic, {}, job});
  return {body.mesh.nodeCount(), std::sqrt(body.mesh.surfaceArea() / body.mesh.triangleCount()),
          body.displacementError(exact)};
}

/// `controlPoints` along each side of a patch.
ConvergenceStep solveSplines(int controlPoints, const Job& job) {
  const ExactField exact = exactField();
  const SplineBody body(
      fixedWhere(app::splineSurfaceOf(modeling::makeSphere(kRadius, controlPoints)), isBelow),
      kMaterial, exact, {1e-6}, Precision::kAutomatic, job);
  return {body.surface.coefficientCount(), std::sqrt(body.area() / body.surface.elementCount()),
          body.displacementError(exact)};
}

}  // namespace

std::vector<ConvergenceStep> sphereConvergence(Engine engine, bool isShort, const Job& job) {
  std::vector<int> refinements;
  if (engine == Engine::kTriangles)
    refinements = isShort ? std::vector{6, 9, 13} : std::vector{4, 6, 9, 13, 18};
  else
    refinements = isShort ? std::vector{7, 9, 11} : std::vector{5, 7, 9, 11, 13};
  std::vector<ConvergenceStep> steps;
  for (const int refinement : refinements) {
    job.throwIfCancelled();
    ConvergenceStep step = engine == Engine::kTriangles ? solveTriangles(refinement, job)
                                                        : solveSplines(refinement, job);
    if (!steps.empty())
      step.order =
          std::log(steps.back().error / step.error) / std::log(steps.back().size / step.size);
    steps.push_back(step);
  }
  return steps;
}

std::vector<Check> checksOf(const std::vector<ConvergenceStep>& steps, Engine engine) {
  // What the best functions of each space reach is the degree + 1: 2 and 4. Errors by number of
  // coefficients.
  const bool isTriangles = engine == Engine::kTriangles;
  const std::map<int, double> most = isTriangles
                                         ? std::map<int, double>{{488, 6e-3}, {1016, 3e-3}}
                                         : std::map<int, double>{{386, 5e-4}, {602, 1.5e-4}};
  std::vector<Check> checks;
  for (const ConvergenceStep& step : steps)
    if (const auto found = most.find(step.coefficients); found != most.end())
      checks.push_back({"u, n = " + std::to_string(step.coefficients), step.error, found->second});
  checks.push_back({"order of u", steps.back().order, isTriangles ? 1.7 : 4.0, true});
  return checks;
}

}  // namespace palpa::verification
