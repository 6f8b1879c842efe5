#include <gtest/gtest.h>

#include <algorithm>

#include "app/verification/exact/simple_meshes.h"
#include "app/verification/exact/solved_body.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;
using verification::SolvedBody;

// The linear elements contain every linear field, and on flat faces the traction too. The remaining
// error is the tolerance of the integrals (1e-7 in single blocks, nearly zero in their sum) times
// the condition of the problem.
constexpr double kExact = 1e-8;

verification::ConditionOfTag conditions(std::vector<int> fixed, std::vector<int> rollers) {
  return [=](int tag) {
    const auto in = [tag](const std::vector<int>& list) {
      return std::find(list.begin(), list.end(), tag) != list.end();
    };
    return in(fixed)     ? SlotCondition::kFixed
           : in(rollers) ? SlotCondition::kRoller
                         : SlotCondition::kTraction;
  };
}

struct Patch {
  std::string name;
  std::vector<int> fixed, rollers;
};

class PatchTest : public ::testing::TestWithParam<Patch> {
 protected:
  verification::ConditionOfTag conditionOfTag() const {
    return conditions(GetParam().fixed, GetParam().rollers);
  }
  static verification::ExactField field(const Material& material) {
    const bool incompressible = material.poissonRatio == 0.5;
    return verification::linearField(verification::generalGradient(incompressible),
                                     {0.1, -0.2, 0.05}, material, incompressible ? 0.0004 : 0);
  }
};

TEST_P(PatchTest, BoxIsExact) {
  for (const double nu : {-0.4, 0.3, 0.45, 0.49, 0.5}) {
    const Material material{0.1, nu};
    if (nu == 0.5 && GetParam().fixed.size() == 6) continue;  // see Solvability
    const auto exact = field(material);
    const SolvedBody body(verification::boxMesh({-20, -15, 0}, {20, 15, 20}, 8, 6, 4), material,
                          exact, conditionOfTag());
    std::printf("patch %-16s nu %5.2f  u %.1e  p %.1e  condition %.0e\n", GetParam().name.c_str(),
                nu, body.maxDisplacementError(exact), body.maxTractionError(exact),
                body.problem->conditionEstimate());
    EXPECT_LE(body.maxDisplacementError(exact), kExact) << "nu = " << nu;
    EXPECT_LE(body.maxTractionError(exact), kExact) << "nu = " << nu;
  }
}

TEST_P(PatchTest, PlateIsExact) {
  // 40 x 40 x 2 mm with one cell through the thickness: the elements that face each other are 2.8
  // times as long as the plate is thick.
  for (const double nu : {0.3, 0.49, 0.5}) {
    const Material material{0.1, nu};
    if (nu == 0.5 && GetParam().fixed.size() == 6) continue;
    const auto exact = field(material);
    const SolvedBody body(verification::boxMesh({-20, -20, 0}, {20, 20, 2}, 10, 10, 1), material,
                          exact, conditionOfTag());
    std::printf("plate %-16s nu %5.2f  u %.1e  p %.1e  condition %.0e\n", GetParam().name.c_str(),
                nu, body.maxDisplacementError(exact), body.maxTractionError(exact),
                body.problem->conditionEstimate());
    EXPECT_LE(body.maxDisplacementError(exact), kExact) << "nu = " << nu;
    EXPECT_LE(body.maxTractionError(exact), kExact) << "nu = " << nu;
  }
}

INSTANTIATE_TEST_SUITE_P(Box, PatchTest,
                         ::testing::Values(Patch{"OneFixed", {4}, {}},
                                           Patch{"TwoAdjacentFixed", {0, 4}, {}},
                                           Patch{"ThreeMeetFixed", {0, 2, 4}, {}},
                                           Patch{"AllFixed", {0, 1, 2, 3, 4, 5}, {}},
                                           Patch{"ThreeRollers", {}, {0, 2, 4}}),
                         [](const auto& patch) { return patch.param.name; });

INSTANTIATE_TEST_SUITE_P(FixedMeetsRoller, PatchTest,
                         ::testing::Values(Patch{"FixedAndRoller", {4}, {0, 3}}),
                         [](const auto& patch) { return patch.param.name; });

/// Checks the order of the displacement error of a linear field on a curved body whose part z <
/// `cut` is fixed. The traction of the exact field is computed with the mesh's normals, so the
/// polyhedron would be solved exactly if the elements could represent the traction. The traction is
/// discontinuous, but continuous in the space of the elements: this causes the second-order error
/// measured here.
void expectSecondOrder(const char* name, double cut, double nu,
                       const std::vector<BoundaryMesh>& meshes) {
  const Material material{0.1, nu};
  const bool incompressible = nu == 0.5;
  const auto exact =
      verification::linearField(verification::generalGradient(incompressible), {0.1, -0.2, 0.05},
                                material, incompressible ? 0.0004 : 0);
  std::vector<double> errors;
  std::vector<int> nodes;
  double order = 0;
  for (const BoundaryMesh& mesh : meshes) {
    const SolvedBody body(
        verification::retagged(mesh, 10, [&](const Vector3d& x) { return x[2] < cut; }), material,
        exact, conditions({10}, {}));
    errors.push_back(body.rmsDisplacementError(exact));
    nodes.push_back(mesh.nodeCount());
    const auto k = errors.size();
    if (k > 1)
      order = verification::observedOrder(errors[k - 2], nodes[k - 2], errors[k - 1], nodes[k - 1]);
    std::printf("%-10s nu %.2f  n %5d  error %.2e  order %.2f\n", name, nu, nodes.back(),
                errors.back(), order);
  }
  EXPECT_GE(order, 1.9);
}

TEST(PatchTestCurved, SphereConvergesWithSecondOrder) {
  for (const double nu : {0.3, 0.5})
    expectSecondOrder("sphere", -15, nu,
                      {verification::sphereMesh(25, 5), verification::sphereMesh(25, 8),
                       verification::sphereMesh(25, 12)});
}

TEST(PatchTestCurved, CylinderConvergesWithSecondOrder) {
  for (const double nu : {0.3, 0.5})
    expectSecondOrder(
        "cylinder", 0.01, nu,
        {verification::cylinderMesh(20, 60, 16, 8), verification::cylinderMesh(20, 60, 24, 12),
         verification::cylinderMesh(20, 60, 36, 18)});
}

TEST(PatchTestCurved, TorusConvergesWithSecondOrder) {
  for (const double nu : {0.3, 0.5})
    expectSecondOrder(
        "torus", -4, nu,
        {verification::torusMesh(30, 10, 24, 10), verification::torusMesh(30, 10, 36, 15),
         verification::torusMesh(30, 10, 54, 22)});
}

}  // namespace
}  // namespace palpa::bem
