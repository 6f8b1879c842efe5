#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "app/verification/exact/simple_meshes.h"
#include "bem/base/error.h"
#include "bem/contact/nodal_switching.h"
#include "bem/dense/make_reference_problem.h"
#include "bem/model/surface_point.h"
#include "bem/problem/greens_columns.h"
#include "written_out.h"

namespace palpa::bem {
namespace {

using Eigen::VectorXd;

using Conditions = std::function<SlotCondition(int tag)>;

void expectSwitchingEqualsFreshSolve(const BoundaryMesh& mesh, const Conditions& conditionOfTag,
                                     unsigned seed) {
  const TractionSlots slots(mesh);
  const Material material{0.1, 0.45};
  std::vector<SlotCondition> conditions;
  for (const auto& slot : slots.slots) conditions.push_back(conditionOfTag(slot.tag));
  const std::shared_ptr<const ReferenceProblem> problem =
      makeDenseReferenceProblem(mesh, slots, {conditions, material, {}, Precision::kDouble});
  const DegreesOfFreedom& dofs = problem->dofs();
  const test::WrittenOut written(assemble<double>(mesh, slots, dofs.collocationPoints(mesh, slots),
                                                  material, AssemblyOptions{}, Job{}),
                                 dofs);

  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  VectorXd known(dofs.nodalCount());
  for (double& value : known) value = normal(random);
  const BoundaryField given = dofs.expand(VectorXd::Zero(dofs.count()), known);
  const VectorXd unknown = problem->solve(given).col(0);
  NodalSwitching switching(problem, known, unknown, problem->solveField(given));

  // Nodes of any kind are added in random order, some are removed again.
  for (int step = 0; step < 14; ++step) {
    const auto& members = switching.nodes();
    if (step % 4 == 3) {
      switching.remove(members[random() % members.size()]);
    } else {
      int node = static_cast<int>(random() % mesh.nodes.size());
      while (std::find(members.begin(), members.end(), node) != members.end())
        node = (node + 1) % mesh.nodeCount();
      switching.add(node);
    }
    VectorXd values(3 * static_cast<Eigen::Index>(members.size()));
    VectorXd knownNow = known;
    for (std::size_t s = 0; s < members.size(); ++s)
      for (int k = 0; k < 3; ++k)
        knownNow[3 * members[s] + k] = values[3 * static_cast<Eigen::Index>(s) + k] =
            normal(random);
    const VectorXd fresh = written.solveSwitched(members, knownNow);
    const VectorXd updated = switching.solve(values).v;
    ASSERT_LE((updated - fresh).norm(), 1e-9 * fresh.norm()) << "after step " << step;
  }
}

TEST(NodalSwitching, EqualsFreshSolveOnASphereWithAFixedPart) {
  BoundaryMesh mesh = verification::sphereMesh(25, 5);
  for (int t = 0; t < mesh.triangleCount(); ++t)
    mesh.tags[t] = mesh.point(t, Eigen::Vector3d::Constant(1.0 / 3))[2] < -12 ? 1 : 0;
  const auto conditions = [](int tag) {
    return tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction;
  };
  expectSwitchingEqualsFreshSolve(mesh, conditions, 1);
}

TEST(NodalSwitching, EqualsFreshSolveWithRollers) {
  const auto conditions = [](int tag) {
    return tag % 2 == 0 ? SlotCondition::kRoller : SlotCondition::kTraction;
  };
  expectSwitchingEqualsFreshSolve(verification::boxMesh({0, 0, 0}, {3, 2, 1}, 4, 3, 3), conditions,
                                  2);
}

TEST(NodalSwitching, EqualsFreshSolveWithExtraTractionsAtAnEdge) {
  const auto conditions = [](int tag) {
    return tag == 0 || tag == 4 ? SlotCondition::kFixed : SlotCondition::kTraction;
  };
  expectSwitchingEqualsFreshSolve(verification::boxMesh({0, 0, 0}, {3, 2, 1}, 4, 3, 3), conditions,
                                  3);
}

TEST(NodalSwitching, FieldSatisfiesTheBoundaryEquations) {
  // The field of the solution must satisfy H u = G p to the rounding of a solve in double
  // precision.
  const BoundaryMesh mesh = verification::boxMesh({0, 0, 0}, {3, 2, 1}, 4, 3, 3);
  const TractionSlots slots(mesh);
  std::vector<SlotCondition> conditions;
  for (const auto& slot : slots.slots)
    conditions.push_back(slot.tag == 4 ? SlotCondition::kFixed : SlotCondition::kTraction);
  const std::shared_ptr<const ReferenceProblem> problem =
      makeDenseReferenceProblem(mesh, slots, {conditions, {1.0, 0.3}, {}, Precision::kDouble});
  const auto& dofs = problem->dofs();
  const int node = nearestNode(mesh, {1.5, 1, 1});
  NodalSwitching switching(problem, VectorXd::Zero(dofs.nodalCount()), VectorXd::Zero(dofs.count()),
                           {VectorXd::Zero(dofs.nodalCount()), VectorXd::Zero(3 * slots.count())});
  switching.add(node);
  const auto solution = switching.solve(Eigen::Vector3d(0, 0, -0.1));
  EXPECT_LE(problem->relativeResidual(solution.field), 1e-12);
  EXPECT_NEAR(solution.field.u(3 * node + 2, 0), -0.1, 1e-15);
  EXPECT_LT(solution.switched[2], 0);  // pushed down, so the force points down
}

TEST(GreensColumns, AgreeWithRefinedOnes) {
  const BoundaryMesh mesh = verification::sphereMesh(1, 4);
  const TractionSlots slots(mesh);
  std::vector<SlotCondition> conditions;
  for (const auto& slot : slots.slots)
    conditions.push_back(mesh.nodes[slot.node][2] < -0.5 ? SlotCondition::kFixed
                                                         : SlotCondition::kTraction);
  const std::shared_ptr<const ReferenceProblem> problem =
      makeDenseReferenceProblem(mesh, slots, {conditions, {1.0, 0.3}, {}, Precision::kSingle});
  GreensColumns columns(problem);
  std::vector<int> nodes(mesh.nodeCount());
  std::iota(nodes.begin(), nodes.end(), 0);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(columns.compute(nodes, Job{stop.get_token(), {}, 1}), Cancelled);
  EXPECT_EQ(columns.readyCount(), 0);
  columns.compute(nodes, Job{});
  EXPECT_TRUE(columns.isComplete());
  // Single-precision factors: condition about 1e2 times 6e-8, with a margin.
  int compared = 0;
  for (const int node : {0, 5, 33, 66}) {
    if (!columns.has(node)) continue;
    const std::vector<int> dofs{3 * node, 3 * node + 1, 3 * node + 2};
    const Eigen::MatrixXd refined = problem->greensColumns(dofs);
    for (int axis = 0; axis < 3; ++axis) {
      const VectorXd column =
          Eigen::Map<const Eigen::VectorXf>(columns.column(node, axis), columns.rows())
              .cast<double>();
      EXPECT_LE((column - refined.col(axis)).norm(), 5e-5 * refined.col(axis).norm());
    }
    ++compared;
  }
  EXPECT_GE(compared, 2);
}

}  // namespace
}  // namespace palpa::bem
