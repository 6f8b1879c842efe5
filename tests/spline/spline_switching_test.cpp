#include <algorithm>
#include <random>

#include "bem/contact/nodal_switching.h"
#include "bem/dense/make_reference_problem.h"
#include "bem/spline/spline_assembly.h"
#include "spline_body.h"
#include "written_out.h"

namespace palpa::bem::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const Material kMaterial{0.1, 0.4};
const AssemblyOptions kOptions{1e-6};

/// The problem in which tractions (of free coefficients) and displacements (of fixed ones) are
/// additional unknowns s and the values given instead are further equations,
///   A v + Ā (v̄ + E s) = b,  R (u of v and v̄ + E s) = values,
/// solved as a whole.
VectorXd solvedAtOnce(const SplineDiscretisation& on, const DegreesOfFreedom& dofs,
                      const WrittenOut& written, const std::vector<int>& nodes,
                      const VectorXd& known, const VectorXd& load, const VectorXd& values) {
  const Index count = dofs.count(), added = values.size();
  const BoundaryField ofUnknowns = dofs.expand(MatrixXd::Identity(count, count), MatrixXd());
  const BoundaryField ofKnown =
      dofs.expand(MatrixXd::Zero(count, dofs.nodalCount()),
                  MatrixXd::Identity(dofs.nodalCount(), dofs.nodalCount()));
  const MatrixXd weights = on.placeWeights();
  VectorXd rest = known;
  for (const int node : nodes) rest.segment<3>(3 * node).setZero();
  MatrixXd A = MatrixXd::Zero(count + added, count + added);
  VectorXd b(count + added);
  A.topLeftCorner(count, count) = written.A;
  b.head(count) = load - written.ABar * rest;
  for (std::size_t s = 0; s < nodes.size(); ++s)
    for (int k = 0; k < 3; ++k) {
      const Index row = count + 3 * static_cast<Index>(s) + k, dof = 3 * nodes[s] + k;
      A.block(0, row, count, 1) = written.ABar.col(dof);
      b[row] = values[row - count];
      if (dofs.isConstrained(static_cast<int>(dof))) {
        A(row, dof) = 1;
        continue;
      }
      // Free coefficients have the frame of space.
      Eigen::RowVectorXd measured = Eigen::RowVectorXd::Zero(dofs.nodalCount());
      for (int j = 0; j < dofs.nodeCount(); ++j) measured[3 * j + k] = weights(nodes[s], j);
      A.row(row).head(count) = measured * ofUnknowns.u;
      const Eigen::RowVectorXd ofKnownRow = measured * ofKnown.u;
      for (std::size_t other = 0; other < nodes.size(); ++other)
        for (int c = 0; c < 3; ++c)
          A(row, count + 3 * static_cast<Index>(other) + c) = ofKnownRow[3 * nodes[other] + c];
      b[row] -= ofKnownRow * rest;
    }
  VectorXd x = A.partialPivLu().solve(b);
  for (std::size_t s = 0; s < nodes.size(); ++s)
    x.segment<3>(3 * nodes[s]) = x.segment<3>(count + 3 * static_cast<Index>(s));
  return x.head(count);
}

TEST(NodalSwitching, OfSplinesGivesTheDisplacementAtTheGrevillePoint) {
  // A ball whose lower sixth is fixed. Tractions and displacements are given everywhere at random;
  // coefficients of any kind join and leave, neighbours and those beside the support among them.
  const auto ball = discretised(modeling::makeSphere(25, 5), 12, [](const Eigen::Vector3d& x) {
    return x.z() < -std::max(std::abs(x.x()), std::abs(x.y())) ? 1 : 0;
  });
  const std::shared_ptr<const ReferenceProblem> problem = makeDenseReferenceProblem(
      *ball, {fixedWhereTagged(ball->slots()), kMaterial, kOptions, Precision::kDouble});
  const DegreesOfFreedom& dofs = problem->dofs();
  ASSERT_TRUE(dofs.extraSlots().empty());
  const auto operators = assemble<double>(
      ball->surface(), ball->tractions(),
      collocationEquations(grevilleCollocation(ball->surface())), kMaterial, kOptions, Job{});
  const WrittenOut written(operators, dofs);

  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  VectorXd known(dofs.nodalCount());
  for (double& value : known) value = normal(random);
  BoundaryField given = dofs.expand(VectorXd::Zero(dofs.count()), known);
  // A load that is not among the known values of coefficients: on one of the slots of one.
  VectorXd slotLoad = VectorXd::Zero(given.p.rows());
  for (int s = 0; s < ball->slots().count(); ++s)
    if (dofs.isFree(ball->slots().slots[s].node)) slotLoad[3 * s] = 1e-3 * normal(random);
  given.p += slotLoad;
  const VectorXd load = operators.G.view() * slotLoad;
  NodalSwitching switching(problem, known, problem->solve(given).col(0), problem->solveField(given),
                           ball->placeWeights());

  const MatrixXd weights = ball->placeWeights();
  int besideTheSupport = 0, fixed = 0;
  for (int step = 0; step < 14; ++step) {
    const std::vector<int>& members = switching.nodes();
    if (step % 4 == 3) {
      switching.remove(members[random() % members.size()]);
    } else {
      int node = static_cast<int>(random() % ball->places().size());
      while (std::find(members.begin(), members.end(), node) != members.end())
        node = (node + 1) % dofs.nodeCount();
      switching.add(node);
      fixed += dofs.isFree(node) ? 0 : 1;
      for (int j = 0; j < dofs.nodeCount(); ++j)
        if (dofs.isFree(node) && !dofs.isFree(j) && weights(node, j) > 0.01) {
          ++besideTheSupport;
          break;
        }
    }
    VectorXd values(3 * static_cast<Index>(members.size()));
    for (double& value : values) value = normal(random);
    const auto solution = switching.solve(values);
    const VectorXd expected = solvedAtOnce(*ball, dofs, written, members, known, load, values);
    ASSERT_LE((solution.v - expected).norm(), 1e-9 * expected.norm()) << "after step " << step;
    EXPECT_LE(problem->relativeResidual(solution.field), 1e-11);
    for (std::size_t s = 0; s < members.size(); ++s) {
      if (!dofs.isFree(members[s])) continue;
      Eigen::Vector3d there = Eigen::Vector3d::Zero();
      for (int j = 0; j < dofs.nodeCount(); ++j)
        there += weights(members[s], j) * solution.field.u.col(0).segment<3>(3 * j);
      EXPECT_LE((there - values.segment<3>(3 * static_cast<Index>(s))).norm(), 1e-10);
    }
  }
  EXPECT_GE(besideTheSupport, 1);
  EXPECT_GE(fixed, 1);
}

}  // namespace
}  // namespace palpa::bem::test
