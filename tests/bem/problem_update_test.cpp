// Incremental updates: problems of moved meshes computed from their predecessors equal full
// rebuilds.
#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "app/verification/exact/simple_meshes.h"
#include "app/verification/exact/solved_body.h"
#include "bem/dense/make_reference_problem.h"
#include "bem/dense/update_reference_problem.h"
#include "bem/problem/greens_columns.h"
#include "bem/triangle/triangle_discretisation.h"

namespace palpa::bem::test {
using namespace verification;
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;

const Material kMaterial{0.1, 0.45};

struct SupportedBody {
  std::string name;
  BoundaryMesh mesh;
  ConditionOfTag conditionOfTag;

  std::vector<SlotCondition> conditions() const {
    std::vector<SlotCondition> conditions;
    for (const auto& slot : TractionSlots(mesh).slots)
      conditions.push_back(conditionOfTag(slot.tag));
    return conditions;
  }
};

std::vector<SupportedBody> bodies() {
  const auto fixedBelow = [](int tag) {
    return tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction;
  };
  // Two fixed faces that meet at an edge have additional tractions with separate collocation
  // points.
  const auto twoFaces = [](int tag) {
    return tag == 4   ? SlotCondition::kFixed
           : tag == 0 ? SlotCondition::kFixed
                      : SlotCondition::kTraction;
  };
  const auto roller = [](int tag) {
    return tag == 1   ? SlotCondition::kFixed
           : tag == 2 ? SlotCondition::kRoller
                      : SlotCondition::kTraction;
  };
  BoundaryMesh rolled =
      retagged(sphereMesh(25, 6), 1, [](const Vector3d& x) { return x.z() < -18; });
  return {{"sphere", retagged(sphereMesh(25, 6), 1, [](const Vector3d& x) { return x.z() < -15; }),
           fixedBelow},
          {"box", boxMesh({0, 0, 0}, {30, 20, 20}, 6, 4, 4), twoFaces},
          {"sphere on a roller",
           retagged(std::move(rolled), 2, [](const Vector3d& x) { return x.x() > 15; }), roller}};
}

/// Moves the nodes within `radius` of a node smoothly towards the middle of the body or away from
/// it.
BoundaryMesh dented(BoundaryMesh mesh, int node, double radius, double depth) {
  const Vector3d at = mesh.nodes[node], inward = (Vector3d(1, 2, 3) - at).normalized();
  for (Vector3d& x : mesh.nodes) {
    const double t = (x - at).norm() / radius;
    if (t < 1) x += depth * (1 - t * t) * (1 - t * t) * inward;
  }
  return mesh;
}

/// Largest difference of the residuals of two problems for random fields, over the largest
/// residual.
double operatorDifference(const ReferenceProblem& a, const ReferenceProblem& b) {
  const Eigen::Index n = a.dofs().nodalCount(),
                     q = 3 * static_cast<Eigen::Index>(a.dofs().slotCount());
  const BoundaryField field{MatrixXd::Random(n, 4), MatrixXd::Random(q, 4) * 0.1};
  const MatrixXd ofA = a.residual(field), ofB = b.residual(field);
  return (ofA - ofB).lpNorm<Eigen::Infinity>() / ofB.lpNorm<Eigen::Infinity>();
}

/// Largest difference of the solutions of two problems for random known values, over the largest
/// value.
double solutionDifference(const ReferenceProblem& a, const ReferenceProblem& b,
                          ReferenceProblem::Effort effort) {
  const MatrixXd known = MatrixXd::Random(b.dofs().nodalCount(), 3);
  const auto fieldOf = [&](const ReferenceProblem& problem) {
    return problem.solveField(b.dofs().expand(MatrixXd::Zero(b.dofs().count(), 3), known), effort);
  };
  const BoundaryField ofA = fieldOf(a), ofB = fieldOf(b);
  return std::max((ofA.u - ofB.u).lpNorm<Eigen::Infinity>() / ofB.u.lpNorm<Eigen::Infinity>(),
                  (ofA.p - ofB.p).lpNorm<Eigen::Infinity>() / ofB.p.lpNorm<Eigen::Infinity>());
}

std::shared_ptr<const ReferenceProblem> made(const TriangleDiscretisation& body,
                                             const SupportedBody& supported, Precision precision) {
  return makeDenseReferenceProblem(body, {supported.conditions(), kMaterial, {}, precision});
}

TEST(ProblemUpdate, EqualsAFullRebuild) {
  for (const SupportedBody& supported : bodies()) {
    SCOPED_TRACE(supported.name);
    const TriangleDiscretisation body(supported.mesh);
    const auto base = made(body, supported, Precision::kDouble);
    for (const int node : {0, 7, 40, 77}) {
      const TriangleDiscretisation moved(dented(supported.mesh, node, 9, 1.5));
      const auto updated =
          updateDenseReferenceProblem(base, body, moved, {supported.conditions(), kMaterial, {}});
      ASSERT_TRUE(updated) << node;
      const auto rebuilt = made(moved, supported, Precision::kDouble);
      // The tolerance of the integrals is 1e-7; the base problem must differ clearly.
      EXPECT_LE(operatorDifference(*updated, *rebuilt), 2e-7) << node;
      EXPECT_GE(operatorDifference(*base, *rebuilt), 1e-4) << node;
      using Effort = ReferenceProblem::Effort;
      EXPECT_LE(solutionDifference(*updated, *rebuilt, Effort::kRefined), 1e-6) << node;
      EXPECT_LE(solutionDifference(*updated, *rebuilt, Effort::kFast), 2e-5) << node;
    }
  }
}

/// A translation of the body needs no tractions, also after an update: the free terms are still
/// correct.
TEST(ProblemUpdate, KeepsRigidTranslations) {
  const SupportedBody supported = bodies().front();
  const TriangleDiscretisation body(supported.mesh), moved(dented(supported.mesh, 30, 10, 2));
  const auto updated = updateDenseReferenceProblem(made(body, supported, Precision::kDouble), body,
                                                   moved, {supported.conditions(), kMaterial, {}});
  ASSERT_TRUE(updated);
  BoundaryField field{
      MatrixXd::Zero(updated->dofs().nodalCount(), 1),
      MatrixXd::Zero(3 * static_cast<Eigen::Index>(updated->dofs().slotCount()), 1)};
  for (Eigen::Index k = 0; k < field.u.rows(); k += 3) field.u.block<3, 1>(k, 0) << 1, -2, 0.5;
  EXPECT_LE(updated->residual(field).lpNorm<Eigen::Infinity>(), 1e-10);
}

TEST(ProblemUpdate, FollowsRandomEditsInEveryPrecision) {
  const SupportedBody supported = bodies().front();
  const TriangleDiscretisation body(supported.mesh);
  std::mt19937 random(11);
  const auto pick = [&](int least, int most) {
    return std::uniform_int_distribution<int>(least, most)(random);
  };
  for (const Precision precision : {Precision::kDouble, Precision::kMixed, Precision::kSingle}) {
    const auto base = made(body, supported, precision);
    const bool isSingle = precision == Precision::kSingle;
    BoundaryMesh mesh = supported.mesh;
    for (int edit = 0; edit < 6; ++edit) {
      // One of the edits undoes the previous ones.
      mesh = edit == 3 ? supported.mesh : mesh;
      mesh = dented(mesh, pick(0, 150), pick(5, 9), 0.3 * pick(-4, 4));
      const TriangleDiscretisation moved(mesh);
      const auto updated =
          updateDenseReferenceProblem(base, body, moved, {supported.conditions(), kMaterial, {}});
      ASSERT_TRUE(updated) << edit;
      const auto rebuilt = made(moved, supported, precision);
      EXPECT_LE(operatorDifference(*updated, *rebuilt), isSingle ? 2e-6 : 2e-7) << edit;
      EXPECT_LE(solutionDifference(*updated, *rebuilt, ReferenceProblem::Effort::kRefined),
                isSingle ? 1e-4 : 1e-6)
          << edit;
    }
  }
}

TEST(ProblemUpdate, SuppliesColumnsOfTheGreensFunction) {
  const SupportedBody supported = bodies().front();
  const TriangleDiscretisation body(supported.mesh), moved(dented(supported.mesh, 100, 9, -2));
  std::shared_ptr<const ReferenceProblem> updated =
      updateDenseReferenceProblem(made(body, supported, Precision::kSingle), body, moved,
                                  {supported.conditions(), kMaterial, {}});
  ASSERT_TRUE(updated);
  GreensColumns columns(updated), rebuilt(made(moved, supported, Precision::kDouble));
  std::vector<int> nodes = rebuilt.nodesNear(moved.mesh().nodes, moved.mesh().nodes[100]);
  nodes.resize(4);
  columns.compute(nodes, {});
  rebuilt.compute(nodes, {}, ReferenceProblem::Effort::kRefined);
  for (const int node : nodes) {
    double difference = 0, largest = 0;
    for (int axis = 0; axis < 3; ++axis)
      for (Eigen::Index row = 0; row < columns.rows(); ++row) {
        const double value = rebuilt.column(node, axis)[row];
        difference = std::max(difference, std::abs(columns.column(node, axis)[row] - value));
        largest = std::max(largest, std::abs(value));
      }
    EXPECT_LE(difference, 5e-5 * largest) << node;
  }
}

TEST(ProblemUpdate, IsSkippedWhereImpossibleOrTooExpensive) {
  const SupportedBody supported = bodies().front();
  const TriangleDiscretisation body(supported.mesh);
  const auto base = made(body, supported, Precision::kDouble);
  const auto update = [&](const BoundaryMesh& mesh,
                          const std::shared_ptr<const ReferenceProblem>& from) {
    return updateDenseReferenceProblem(from, body, TriangleDiscretisation(mesh),
                                       {supported.conditions(), kMaterial, {}});
  };
  EXPECT_FALSE(update(dented(supported.mesh, 30, 100, 1), base)) << "nearly everything moved";
  BoundaryMesh turned = supported.mesh;
  std::rotate(turned.triangles[0].begin(), turned.triangles[0].begin() + 1,
              turned.triangles[0].end());
  EXPECT_FALSE(update(turned, base));
  BoundaryMesh otherPart = supported.mesh;
  otherPart.tags[5] = 1 - otherPart.tags[5];
  EXPECT_FALSE(updateDenseReferenceProblem(
      base, body, TriangleDiscretisation(otherPart),
      {SupportedBody{"", otherPart, supported.conditionOfTag}.conditions(), kMaterial, {}}));
  const std::shared_ptr<const ReferenceProblem> updated =
      update(dented(supported.mesh, 30, 8, 1), base);
  ASSERT_TRUE(updated);
  EXPECT_FALSE(update(supported.mesh, updated)) << "it shares the factors of its predecessor";
  EXPECT_THROW(updated->write([](std::span<const std::byte>) {}), std::logic_error);
}

TEST(ProblemUpdate, Stops) {
  const SupportedBody supported = bodies().front();
  const TriangleDiscretisation body(supported.mesh), moved(dented(supported.mesh, 30, 8, 1));
  const auto base = made(body, supported, Precision::kDouble);
  std::stop_source stop;
  Job job;
  job.stop = stop.get_token();
  const auto updated =
      updateDenseReferenceProblem(base, body, moved, {supported.conditions(), kMaterial, {}}, job);
  ASSERT_TRUE(updated);
  stop.request_stop();
  EXPECT_THROW(
      updateDenseReferenceProblem(base, body, moved, {supported.conditions(), kMaterial, {}}, job),
      Cancelled);
  const std::vector<int> column{0};
  EXPECT_THROW(updated->greensColumns(column, ReferenceProblem::Effort::kRefined, job), Cancelled);
}

}  // namespace
}  // namespace palpa::bem::test
