#include "bem/triangle/results.h"

#include <gtest/gtest.h>

#include <numeric>

#include "app/verification/exact/simple_meshes.h"
#include "app/verification/exact/solved_body.h"

namespace palpa::bem {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using verification::SolvedBody;

const Vector3d kSource(8, -5, 45), kForce(0.03, -0.02, 0.06);

/// Sphere of radius 25 mm in the field of a point force 20 mm above it.
struct Sphere {
  verification::ExactField exact;
  SolvedBody body;
  Sphere(int cells, double nu)
      : exact(verification::kelvinField(kSource, kForce, {0.1, nu})),
        body(verification::retagged(verification::sphereMesh(25, cells), 1,
                                    [](const Vector3d& x) { return x[2] < -10; }),
             {0.1, nu}, exact,
             [](int tag) { return tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction; }) {}
};

double largestStress(const Sphere& sphere) {
  double largest = 0;
  for (const Vector3d& x : sphere.body.mesh.nodes)
    largest = std::max(largest, sphere.exact.stress(x).norm());
  return largest;
}

/// Root mean square error of the surface stress over the largest stress.
double surfaceStressError(const Sphere& sphere) {
  const SolvedBody& body = sphere.body;
  const auto stress =
      surfaceStress(body.mesh, body.slots, body.field.u.col(0), body.field.p.col(0), body.material);
  double sum = 0;
  for (int s = 0; s < body.slots.count(); ++s)
    sum +=
        (stress[s] - sphere.exact.stress(body.mesh.nodes[body.slots.slots[s].node])).squaredNorm();
  return std::sqrt(sum / body.slots.count()) / largestStress(sphere);
}

TEST(SurfaceStress, ConvergesToTheStressOfThePointForce) {
  for (const double nu : {0.3, 0.5}) {
    const double coarse = surfaceStressError(Sphere(6, nu)),
                 fine = surfaceStressError(Sphere(11, nu));
    std::printf("surface stress nu %.1f: rms error %.2e at n = 218, %.2e at 728\n", nu, coarse,
                fine);
    EXPECT_LE(fine, 0.03) << "derivatives of linear elements of 3.6 mm, averaged at the nodes";
    EXPECT_LT(fine, 0.6 * coarse) << "at least first order: 6/11 of the mesh size";
  }
}

TEST(SurfaceStress, IsExactForALinearFieldOnABox) {
  for (const double nu : {0.3, 0.49}) {
    const Material material{0.1, nu};
    const auto exact =
        verification::linearField(verification::generalGradient(false), {0, 0, 0}, material);
    const SolvedBody body(
        verification::boxMesh({-20, -15, 0}, {20, 15, 20}, 6, 5, 4), material, exact,
        [](int tag) { return tag == 4 ? SlotCondition::kFixed : SlotCondition::kTraction; });
    const Matrix3d expected = exact.stress(Vector3d::Zero());
    for (const Matrix3d& stress :
         surfaceStress(body.mesh, body.slots, body.field.u.col(0), body.field.p.col(0), material))
      EXPECT_LE((stress - expected).norm(), 1e-7 * expected.norm());  // as the patch test
  }
}

TEST(InteriorState, EqualsTheStateOfThePointForce) {
  for (const double nu : {0.3, 0.5}) {
    const Sphere sphere(9, nu);
    const SolvedBody& body = sphere.body;
    double displacementError = 0, stressError = 0;
    for (const Vector3d& x : {Vector3d(0, 0, 0), Vector3d(10, 5, 8), Vector3d(-12, 9, -4),
                              Vector3d(3, -2, 17), Vector3d(0, 0, -17)}) {
      const auto state = interiorState(body.mesh, body.slots, body.field.u.col(0),
                                       body.field.p.col(0), body.material, x);
      ASSERT_TRUE(state);
      const Vector3d u = sphere.exact.displacement(x);
      const Matrix3d stress = sphere.exact.stress(x);
      displacementError = std::max(displacementError, (state->displacement - u).norm() / u.norm());
      stressError = std::max(stressError, (state->stress - stress).norm() / stress.norm());
    }
    std::printf("interior nu %.1f: u %.1e, stress %.1e\n", nu, displacementError, stressError);
    EXPECT_LE(displacementError, 0.01) << "second order, elements of 4.4 mm";
    EXPECT_LE(stressError, 0.03) << "second order; some of these stresses are small";
  }
}

TEST(InteriorState, IsEmptyOutsideTheBodyAndInItsCavity) {
  const BoundaryMesh mesh = verification::hollowSphereMesh(10, 25, 3, 4);
  const TractionSlots slots(mesh);
  const Eigen::VectorXd u = Eigen::VectorXd::Zero(3 * mesh.nodeCount());
  const Eigen::VectorXd p = Eigen::VectorXd::Zero(3 * slots.count());
  EXPECT_FALSE(interiorState(mesh, slots, u, p, Material{0.1, 0.3}, {0, 0, 40}));
  EXPECT_FALSE(interiorState(mesh, slots, u, p, Material{0.1, 0.3}, {1, 2, 3}));
  EXPECT_TRUE(interiorState(mesh, slots, u, p, Material{0.1, 0.3}, {0, 17, 0}));
}

TEST(SurfaceDisplacement, IsAsAccurateBetweenTheNodesAsAtThem) {
  const Sphere sphere(9, 0.45);
  const SolvedBody& body = sphere.body;
  double scale = 0, atNodes = 0, between = 0, interpolated = 0;
  int count = 0;
  for (int k = 0; k < body.mesh.nodeCount(); ++k) {
    const Vector3d u = sphere.exact.displacement(body.mesh.nodes[k]);
    scale = std::max(scale, u.norm());
    atNodes += (body.field.u.col(0).segment<3>(3 * k) - u).squaredNorm();
  }
  for (int t = 0; t < body.mesh.triangleCount(); t += 7) {
    SurfacePoint place{t, Vector3d::Constant(1 / 3.0), Vector3d::Zero(), 0};
    place.position = body.mesh.point(t, place.weights);
    const Vector3d u = sphere.exact.displacement(place.position);
    Vector3d linear = Vector3d::Zero();
    for (const int node : body.mesh.triangles[t])
      linear += body.field.u.col(0).segment<3>(3 * node) / 3;
    between += (surfaceDisplacement(body.mesh, body.slots, body.field.u.col(0), body.field.p.col(0),
                                    body.material, place) -
                u)
                   .squaredNorm();
    interpolated += (linear - u).squaredNorm();
    ++count;
  }
  atNodes = std::sqrt(atNodes / body.mesh.nodeCount()) / scale;
  between = std::sqrt(between / count) / scale;
  interpolated = std::sqrt(interpolated / count) / scale;
  std::printf("rms error at nodes %.1e, at element centres %.1e (interpolated %.1e)\n", atNodes,
              between, interpolated);
  EXPECT_LE(between, 1.25 * atNodes);
}

TEST(TractionResultant, OfAUniformPressureOnOneFace) {
  const BoundaryMesh mesh = verification::boxMesh({0, 0, 0}, {4, 3, 2}, 4, 3, 2);
  const TractionSlots slots(mesh);
  Eigen::VectorXd p(3 * slots.count());
  for (int s = 0; s < slots.count(); ++s) p.segment<3>(3 * s) = Vector3d(0, 0, -0.5);
  const Resultant found =
      tractionResultant(mesh, slots, p, verification::trianglesWithTag(mesh, 5));
  EXPECT_LE((found.force - Vector3d(0, 0, -6)).norm(), 1e-13);    // 4 x 3 mm^2 times 0.5 MPa
  EXPECT_LE((found.moment - Vector3d(-9, 12, 0)).norm(), 1e-13);  // at (2, 1.5, 2)
}

TEST(VonMises, OfKnownStates) {
  EXPECT_NEAR(vonMises(Vector3d(3, 0, 0).asDiagonal()), 3, 1e-14);     // tension
  EXPECT_NEAR(vonMises(Vector3d(-3, -3, -3).asDiagonal()), 0, 1e-14);  // pressure
  EXPECT_NEAR(vonMises(Vector3d(2, 2, 0).asDiagonal()), 2, 1e-14);     // biaxial tension
  Matrix3d shear = Matrix3d::Zero();
  shear(0, 1) = shear(1, 0) = 2;
  EXPECT_NEAR(vonMises(shear), 2 * std::sqrt(3.0), 1e-14);
}

}  // namespace
}  // namespace palpa::bem
