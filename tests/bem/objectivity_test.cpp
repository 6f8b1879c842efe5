#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <random>

#include "app/verification/exact/simple_meshes.h"
#include "app/verification/exact/solved_body.h"
#include "bem/triangle/assembly.h"
#include "bem/triangle/results.h"

namespace palpa::bem {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

/// Cylinder clamped at the base and twisted and pulled at the top by exact data of an arbitrary
/// field: only the transformation matters.
verification::ExactField loads(const Material& material) {
  return verification::kelvinField({30, 18, 70}, {0.3, -0.2, 0.6}, material);
}
constexpr auto kClamped = [](int tag) {
  return tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction;
};
const Material kMaterial{0.1, 0.45};

BoundaryMesh cylinder() {
  return verification::cylinderMesh(20, 60, 16, 8);
}

TEST(Objectivity, ResultsRotateAndTranslateWithTheBody) {
  const Matrix3d turn =
      Eigen::AngleAxisd(1.1, Vector3d(0.3, -0.8, 0.5).normalized()).toRotationMatrix();
  const Vector3d shift(300, -120, 45);
  BoundaryMesh moved = cylinder();
  for (Vector3d& x : moved.nodes) x = turn * x + shift;
  const auto exact = loads(kMaterial);
  const auto back = [&](const Vector3d& x) { return Vector3d(turn.transpose() * (x - shift)); };
  const verification::ExactField turned{
      [&](const Vector3d& x) { return Vector3d(turn * exact.displacement(back(x))); },
      [&](const Vector3d& x) { return Matrix3d(turn * exact.stress(back(x)) * turn.transpose()); }};
  const verification::SolvedBody here(cylinder(), kMaterial, exact, kClamped);
  const verification::SolvedBody there(moved, kMaterial, turned, kClamped);
  const MatrixXd u =
      turn * Eigen::Map<const MatrixXd>(here.field.u.data(), 3, here.field.u.size() / 3);
  const MatrixXd p =
      turn * Eigen::Map<const MatrixXd>(here.field.p.data(), 3, here.field.p.size() / 3);
  // Batches of points may change the rule where a distance lies on a limit: the error is the
  // tolerance of the integrals, 1e-7, in single blocks.
  EXPECT_LE((u.reshaped() - there.field.u.col(0)).norm(), 1e-7 * u.norm());
  EXPECT_LE((p.reshaped() - there.field.p.col(0)).norm(), 1e-7 * p.norm());
}

TEST(Objectivity, ResultsScaleWithLengthAndStiffness) {
  const verification::SolvedBody base(cylinder(), kMaterial, loads(kMaterial), kClamped);
  for (const double length : {1e-3, 1e3})
    for (const double stiffness : {1e-3, 1e6}) {
      const Material material{0.1 * stiffness, 0.45};
      BoundaryMesh mesh = cylinder();
      for (Vector3d& x : mesh.nodes) x *= length;
      const auto exact = loads(kMaterial);
      const verification::ExactField scaled{
          [&](const Vector3d& x) { return Vector3d(length * exact.displacement(x / length)); },
          [&](const Vector3d& x) { return Matrix3d(stiffness * exact.stress(x / length)); }};
      const verification::SolvedBody body(mesh, material, scaled, kClamped);
      // Unknowns are scaled by E / size: rounding times the condition (about 1e3), and changes of
      // rule as above.
      EXPECT_LE((body.field.u / length - base.field.u).norm(), 1e-7 * base.field.u.norm());
      EXPECT_LE((body.field.p / stiffness - base.field.p).norm(), 1e-7 * base.field.p.norm());
      EXPECT_NEAR(body.problem->conditionEstimate() / base.problem->conditionEstimate(), 1, 1e-3);
    }
}

TEST(Objectivity, ResultsDoNotDependOnTheNumberingOfNodesAndTriangles) {
  const BoundaryMesh mesh = cylinder();
  std::vector<int> newIndex(mesh.nodes.size()), order(mesh.triangles.size());
  std::iota(newIndex.begin(), newIndex.end(), 0);
  std::iota(order.begin(), order.end(), 0);
  std::mt19937 random(7);
  std::shuffle(newIndex.begin(), newIndex.end(), random);
  std::shuffle(order.begin(), order.end(), random);
  BoundaryMesh renamed = mesh;
  for (int k = 0; k < mesh.nodeCount(); ++k) renamed.nodes[newIndex[k]] = mesh.nodes[k];
  for (int t = 0; t < mesh.triangleCount(); ++t) {
    for (int c = 0; c < 3; ++c)
      renamed.triangles[t][c] = newIndex[mesh.triangles[order[t]][(c + t) % 3]];
    renamed.tags[t] = mesh.tags[order[t]];
    renamed.smoothingGroups[t] = mesh.smoothingGroups[order[t]];
  }
  const verification::SolvedBody base(mesh, kMaterial, loads(kMaterial), kClamped);
  const verification::SolvedBody other(renamed, kMaterial, loads(kMaterial), kClamped);
  double difference = 0;
  for (int k = 0; k < mesh.nodeCount(); ++k)
    difference = std::max(difference, (base.field.u.col(0).segment<3>(3 * k) -
                                       other.field.u.col(0).segment<3>(3 * newIndex[k]))
                                          .norm());
  // Other neighbours in a batch change the rule at limits: the tolerance of the integrals.
  EXPECT_LE(difference, 1e-7 * base.field.u.lpNorm<Eigen::Infinity>());
  EXPECT_NEAR(strainEnergy(base.mesh, base.slots, base.field.u.col(0), base.field.p.col(0)),
              strainEnergy(other.mesh, other.slots, other.field.u.col(0), other.field.p.col(0)),
              1e-7 * strainEnergy(base.mesh, base.slots, base.field.u.col(0), base.field.p.col(0)));
}

TEST(Objectivity, AssemblyDoesNotDependOnTheNumberOfThreads) {
  const BoundaryMesh mesh = cylinder();
  const TractionSlots slots(mesh);
  const auto points = nodalCollocation(mesh);
  Job one, two;
  one.threads = 1;
  two.threads = 2;
  const auto a = assemble<double>(mesh, slots, points, kMaterial, {}, one);
  const auto b = assemble<double>(mesh, slots, points, kMaterial, {}, two);
  EXPECT_TRUE(a.H.view() == b.H.view()) << "to the last bit";
  EXPECT_TRUE(a.G.view() == b.G.view()) << "to the last bit";
  const auto c = assemble<float>(mesh, slots, points, kMaterial, {}, one);
  const auto d = assemble<float>(mesh, slots, points, kMaterial, {}, two);
  EXPECT_TRUE(c.H.view() == d.H.view() && c.G.view() == d.G.view()) << "to the last bit";
}

}  // namespace
}  // namespace palpa::bem
