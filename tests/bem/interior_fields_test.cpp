#include <gtest/gtest.h>

#include "app/verification/exact/simple_meshes.h"
#include "app/verification/exact/solved_body.h"
#include "app/verification/exact/textbook_fields.h"
#include "bem/triangle/triangle_interior.h"

// Fields inside two bodies of the textbooks, computed from the solution on the surface.
namespace palpa::bem {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using verification::ExactField;
using verification::SolvedBody;

SlotCondition fixedAtTagOne(int tag) {
  return tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction;
}

/// Largest errors of displacement and stress at some points, over the largest exact values there.
std::pair<double, double> errorsAt(const SolvedBody& body, const ExactField& exact,
                                   const std::vector<Vector3d>& points) {
  const TriangleInterior interior(body.mesh, body.slots, body.material, points, {});
  const auto states = interior.evaluate(body.field.u.col(0), body.field.p.col(0), {});
  double displacement = 0, stress = 0, largestU = 0, largestStress = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vector3d u = exact.displacement(points[k]);
    const Matrix3d sigma = exact.stress(points[k]);
    largestU = std::max(largestU, u.norm());
    largestStress = std::max(largestStress, sigma.norm());
    displacement = verification::worse(displacement, (states[k].displacement - u).norm());
    stress = verification::worse(stress, (states[k].stress - sigma).norm());
  }
  return {displacement / largestU, stress / largestStress};
}

TEST(TextbookFields, ObeyHookesLawAndEquilibrium) {
  const Material material{0.1, 0.3};
  const Vector3d x(9, -7, 12);
  for (const ExactField& field :
       {verification::pressurisedSphereField(10, 25, 0.01, material),
        verification::pressurisedSphereField(10, 25, 0.01, material, {3, 4, -5}),
        verification::bendingField(0.01, material)}) {
    const Matrix3d stress = field.stress(x);
    EXPECT_LE(
        (verification::hooke(verification::differences(field.displacement, x, 0.1), material) -
         stress)
            .norm(),
        1e-6 * stress.norm());
    Vector3d divergence = Vector3d::Zero();
    for (int axis = 0; axis < 3; ++axis)
      divergence +=
          verification::differences(
              [&](const Vector3d& at) { return Vector3d(field.stress(at).col(axis)); }, x, 0.1)
              .col(axis);
    EXPECT_LE(divergence.norm(), 1e-6 * stress.norm() / 10);
  }
  const ExactField sphere = verification::pressurisedSphereField(10, 25, 0.01, material);
  EXPECT_NEAR(sphere.stress({10, 0, 0})(0, 0), -0.01, 1e-12);
  EXPECT_NEAR(sphere.stress({0, 25, 0})(1, 1), 0, 1e-12);
}

TEST(InteriorFields, OfAPressurisedThickSphere) {
  const Material material{0.1, 0.3};
  const ExactField exact = verification::pressurisedSphereField(12, 25, 0.01, material);
  std::vector<Vector3d> points;
  for (const double radius : {13.0, 15.0, 18.0, 21.0, 24.0})
    for (const Vector3d& direction : {Vector3d(1, 0, 0), Vector3d(1, 2, -2), Vector3d(-3, 1, 1)})
      points.push_back(radius * direction.normalized());
  std::pair<double, double> before{INFINITY, INFINITY};
  for (const int cells : {5, 8}) {
    // The pressure acts inside; the outer surface is guided, as free bodies float.
    const SolvedBody body(
        verification::retagged(verification::hollowSphereMesh(12, 25, cells, cells + 2), 1,
                               [](const Vector3d& x) { return x.norm() > 18; }),
        material, exact, fixedAtTagOne);
    const auto [u, stress] = errorsAt(body, exact, points);
    std::printf("thick sphere, %d nodes: u %.1e, stress %.1e\n", body.mesh.nodeCount(), u, stress);
    EXPECT_LE(u, 0.6 * before.first);
    EXPECT_LE(stress, 0.8 * before.second);
    before = {u, stress};
  }
  EXPECT_LE(before.first, 0.02);
  EXPECT_LE(before.second, 0.04);
}

TEST(InteriorFields, OfPureBending) {
  for (const double nu : {0.3, 0.5}) {
    const Material material{0.1, nu};
    const ExactField exact = verification::bendingField(0.004, material);
    std::vector<Vector3d> points;
    for (const double z : {-9.0, -4.0, 0.0, 5.0, 9.5})
      for (const double x : {-15.0, 0.0, 12.0}) points.emplace_back(x, 0.3 * z, z);
    std::pair<double, double> before{INFINITY, INFINITY};
    for (const int cells : {4, 7}) {
      const SolvedBody body(
          verification::boxMesh({-20, -10, -10}, {20, 10, 10}, 2 * cells, cells, cells), material,
          exact, fixedAtTagOne);
      const auto [u, stress] = errorsAt(body, exact, points);
      std::printf("bending, nu %.2f, %d nodes: u %.1e, stress %.1e\n", nu, body.mesh.nodeCount(), u,
                  stress);
      EXPECT_LE(u, 0.6 * before.first);
      EXPECT_LE(stress, 0.8 * before.second);
      before = {u, stress};
    }
    // The largest displacement is the displacement of the free end.
    EXPECT_LE(before.first, 0.08);
    EXPECT_LE(before.second, 0.03);
  }
}

}  // namespace
}  // namespace palpa::bem
