// Equations of quadratic triangles that are means of the residual around nodes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "app/verification/exact/simple_meshes.h"
#include "bem/quadratic/quadratic_assembly.h"
#include "quadratic_body.h"

namespace palpa::bem::test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

const Material kMaterial{0.1, 0.4};

std::vector<SlotCondition> fixedIn(const QuadraticDiscretisation& on, int tag) {
  std::vector<SlotCondition> conditions;
  for (const auto& slot : on.slots().slots)
    conditions.push_back(slot.tag == tag ? SlotCondition::kFixed : SlotCondition::kTraction);
  return conditions;
}

/// A bar with one element from edge to edge, fixed at its end z = 0 (tag 4).
std::unique_ptr<QuadraticDiscretisation> slenderBar(int across, int along) {
  return quadratic(verification::boxMesh({0, 0, 0}, {2, 2, 24}, across, across, along), onFlatFaces,
                   {4});
}

WeightedEquations equationsOf(const QuadraticDiscretisation& on) {
  return quadraticEquations(on.surface(), on.mesh(), on.slots(),
                            on.degreesOfFreedom(fixedIn(on, 4), kMaterial));
}

TEST(AveragedEquations, WeightsSumToOne) {
  const auto bar = slenderBar(1, 8);
  const WeightedEquations equations = equationsOf(*bar);
  ASSERT_FALSE(equations.averaged.empty());
  const VectorXd sums = equations.weights * VectorXd::Ones(equations.weights.cols());
  EXPECT_LE((sums - VectorXd::Ones(sums.size())).cwiseAbs().maxCoeff(), 1e-12);
  for (const AveragedElement& element : equations.averaged)
    EXPECT_LE((element.interpolated.colwise().sum().array() - 1).abs().maxCoeff(), 1e-12);
}

TEST(AveragedEquations, RigidTranslationsHaveNoTraction) {
  const auto bar = slenderBar(1, 8);
  const auto operators =
      assemble<double>(bar->surface(), equationsOf(*bar), kMaterial, {1e-7}, Job{});
  const Eigen::Index nodes = bar->displacementCount();
  for (int c = 0; c < 3; ++c) {
    VectorXd moved = VectorXd::Zero(3 * nodes);
    for (Eigen::Index k = 0; k < nodes; ++k) moved[3 * k + c] = 1;
    EXPECT_LE((operators.H.view() * moved).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(AveragedEquations, FarElementsAreInterpolated) {
  const auto bar = slenderBar(2, 24);
  const WeightedEquations equations = equationsOf(*bar);
  WeightedEquations allNear = equations;
  std::vector<int> all(static_cast<std::size_t>(bar->elementCount()));
  std::iota(all.begin(), all.end(), 0);
  bool isShorter = false;
  for (AveragedElement& element : allNear.averaged) {
    isShorter = isShorter || element.near.size() < all.size() / 2;
    element.near = all;
  }
  ASSERT_TRUE(isShorter);
  const auto found = assemble<double>(bar->surface(), equations, kMaterial, {1e-7}, Job{}),
             expected = assemble<double>(bar->surface(), allNear, kMaterial, {1e-7}, Job{});
  const MatrixXd differenceH = found.H.view() - expected.H.view(),
                 differenceG = found.G.view() - expected.G.view();
  EXPECT_GT(differenceH.cwiseAbs().maxCoeff(), 0);
  EXPECT_LE(differenceH.norm(), 1e-4 * expected.H.view().norm());
  EXPECT_LE(differenceG.norm(), 1e-4 * expected.G.view().norm());
}

TEST(AveragedEquations, SomeEquationsAreTheSameRows) {
  const auto bar = slenderBar(1, 12);
  const WeightedEquations equations = equationsOf(*bar);
  const std::vector<int> some{3, 4, 50};
  const auto all = assemble<double>(bar->surface(), equations, kMaterial, {1e-7}, Job{}),
             few = assemble<double>(bar->surface(), equations.only(some), kMaterial, {1e-7}, Job{});
  const Eigen::Index count = equations.weights.rows();
  for (std::size_t k = 0; k < some.size(); ++k)
    for (int i = 0; i < 3; ++i) {
      const auto row = few.H.view().row(static_cast<Eigen::Index>(i * some.size() + k));
      EXPECT_LE((row - all.H.view().row(i * count + some[k])).cwiseAbs().maxCoeff(), 1e-10);
    }
}

/// The end of a slender bar is pushed aside by a traction: deflection against beam theory, whose
/// own error here is about 0.3 %. Collocation is 15 and 3 % too stiff on these meshes.
TEST(AveragedEquations, SlenderBarsBendAsBeams) {
  const auto deflection = [](int across, int along) {
    const auto bar = slenderBar(across, along);
    const std::vector<SlotCondition> conditions = fixedIn(*bar, 4);
    const auto problem =
        makeDenseReferenceProblem(*bar, {conditions, kMaterial, {1e-7}, Precision::kDouble}, Job{});
    BoundaryConditions data(bar->displacementCount(), bar->slots().count());
    data.ofSlot = conditions;
    for (int slot = 0; slot < bar->slots().count(); ++slot)
      if (bar->slots().slots[slot].tag == 5) data.traction[3 * slot] = 1e-5;
    const BoundaryField field = problem->solveField(problem->dofs().knownField(data));
    double largest = 0;
    for (Eigen::Index k = 0; k < field.u.rows(); k += 3) largest = std::max(largest, field.u(k, 0));
    return largest;
  };
  // Timoshenko: F L^3 / (3 E I) + F L / (5/6 G A).
  constexpr double kForce = 4e-5, kLength = 24, kSecondMoment = 4.0 / 3;
  const double bending =
      kForce * std::pow(kLength, 3) / (3 * kMaterial.youngsModulus * kSecondMoment);
  const double shearing = kForce * kLength / (5.0 / 6 * kMaterial.shear() * 4);
  EXPECT_NEAR(deflection(1, 8), bending + shearing, 0.1 * bending);
  EXPECT_NEAR(deflection(2, 24), bending + shearing, 0.01 * bending);
}

}  // namespace
}  // namespace palpa::bem::test
