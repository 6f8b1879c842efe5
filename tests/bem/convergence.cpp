#include "convergence.h"

#include <algorithm>
#include <cstdio>

#include "app/verification/exact/simple_meshes.h"

namespace palpa::bem::test {
using namespace verification;
namespace {

using Eigen::Vector3d;

std::vector<ConvergenceStep> converge(const char* name, double poissonRatio,
                                      const std::vector<BoundaryMesh>& meshes,
                                      const std::vector<int>& fixedTags, const Vector3d& source) {
  const Material material{0.1, poissonRatio};
  const ExactField exact = kelvinField(source, {0.03, -0.02, 0.06}, material);
  std::vector<ConvergenceStep> steps;
  for (const BoundaryMesh& mesh : meshes) {
    const SolvedBody body(mesh, material, exact, [&](int tag) {
      const bool fixed = std::find(fixedTags.begin(), fixedTags.end(), tag) != fixedTags.end();
      return fixed ? SlotCondition::kFixed : SlotCondition::kTraction;
    });
    ConvergenceStep step{mesh.nodeCount(), body.rmsDisplacementError(exact),
                         body.maxTractionError(exact), 0};
    if (!steps.empty())
      step.order = observedOrder(steps.back().displacementError, steps.back().nodes,
                                 step.displacementError, step.nodes);
    std::printf("%-8s nu %.2f  n %5d  u error %.2e  largest p error %.2e  order of u %.2f\n", name,
                poissonRatio, step.nodes, step.displacementError, step.tractionError, step.order);
    steps.push_back(step);
  }
  return steps;
}

}  // namespace

std::vector<ConvergenceStep> sphereConvergence(double poissonRatio, const std::vector<int>& cells) {
  std::vector<BoundaryMesh> meshes;
  for (const int n : cells)
    meshes.push_back(retagged(sphereMesh(25, n), 1, [](const Vector3d& x) { return x[2] < -10; }));
  return converge("sphere", poissonRatio, meshes, {1}, {8, -5, 38});
}

std::vector<ConvergenceStep> cylinderConvergence(double poissonRatio,
                                                 const std::vector<int>& around, bool topFixed) {
  std::vector<BoundaryMesh> meshes;
  for (const int n : around) meshes.push_back(cylinderMesh(20, 60, n, n / 2));
  const std::vector<int> fixedTags = topFixed ? std::vector<int>{1, 2} : std::vector<int>{1};
  return converge(topFixed ? "fixed cyl" : "cylinder", poissonRatio, meshes, fixedTags,
                  {30, 18, 40});
}

}  // namespace palpa::bem::test
