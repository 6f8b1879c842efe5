#include "bem/triangle/kelvin.h"

#include <gtest/gtest.h>

#include "app/verification/exact/exact_fields.h"
#include "app/verification/exact/simple_meshes.h"
#include "bem/triangle/assembly.h"

namespace palpa::bem {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using verification::differences;

const Vector3d kSource(0.3, -0.2, 0.5), kField(1.4, 0.9, -0.6);

class Kernels : public ::testing::TestWithParam<double> {
 protected:
  Material material() const { return {0.1, GetParam()}; }
};

class CompressibleKernels : public Kernels {};

TEST_P(Kernels, TractionFollowsFromTheDisplacement) {
  // Differences of order 4 with a step of 1e-3 of the distance: about 1e-11 of the gradient. Near
  // nu = 0.5 Hooke's law multiplies this error by nu / (1 - 2 nu).
  const Vector3d normal = Vector3d(0.2, -0.7, 0.4).normalized();
  for (int i = 0; i < 3; ++i) {
    const Matrix3d gradient = differences(
        [&](const Vector3d& y) {
          return Vector3d(kelvinDisplacement(kSource, y, material()).row(i).transpose());
        },
        kField, 2e-3);
    const Vector3d traction =
        kelvinTraction(kSource, kField, normal, material()).row(i).transpose();
    if (GetParam() == 0.5) {
      // The displacement does not determine the pressure; the remaining part has no volume change
      // and the correct shear.
      EXPECT_NEAR(gradient.trace(), 0, 1e-9 * gradient.norm());
      const Vector3d shearPart = material().shear() * (gradient + gradient.transpose()) * normal;
      EXPECT_LE((traction - shearPart).cross(normal).norm(), 1e-9 * traction.norm());
    } else {
      EXPECT_LE((verification::hooke(gradient, material()) * normal - traction).norm(),
                1e-8 * traction.norm());
    }
  }
}

TEST_P(Kernels, StressIsInEquilibrium) {
  for (int i = 0; i < 3; ++i) {
    Vector3d divergence = Vector3d::Zero();
    double scale = 0;
    for (int k = 0; k < 3; ++k) {
      const Matrix3d gradient = differences(
          [&](const Vector3d& y) {
            return Vector3d(
                kelvinTraction(kSource, y, Vector3d::Unit(k), material()).row(i).transpose());
          },
          kField, 2e-3);
      divergence += gradient.col(k);
      scale += gradient.norm();
    }
    // Differences of order 4 with a step of 1e-3 of the distance.
    EXPECT_LE(divergence.norm(), 1e-9 * scale);
  }
}

TEST_P(CompressibleKernels, DisplacementSolvesNaviersEquation) {
  constexpr double kStep = 5e-3;
  const double factor = 1 / (1 - 2 * GetParam());
  for (int i = 0; i < 3; ++i) {
    const auto u = [&](const Vector3d& y) {
      return Vector3d(kelvinDisplacement(kSource, y, material()).row(i).transpose());
    };
    Vector3d residual = Vector3d::Zero();
    double scale = 0;
    for (int k = 0; k < 3; ++k) {
      // Column k of the gradient, differentiated again along every axis.
      const Matrix3d second =
          differences([&](const Vector3d& y) { return Vector3d(differences(u, y, kStep).col(k)); },
                      kField, kStep);
      residual += second.col(k) + factor * second.row(k).transpose();
      scale += second.norm();
    }
    // lap u + grad div u / (1 - 2 nu) = 0; second differences: order 4, and rounding of
    // 1e-16/step^2.
    EXPECT_LE(residual.norm(), 1e-8 * factor * scale);
  }
}

TEST_P(CompressibleKernels, StressKernelsAreHookesLawOfTheDisplacementKernels) {
  const Vector3d p(0.3, -0.5, 0.8), u(-0.2, 0.9, 0.4), n = Vector3d(1, 2, -1).normalized();
  const Matrix3d fromTraction =
      verification::hooke(differences(
                              [&](const Vector3d& x) {
                                return Vector3d(kelvinDisplacement(x, kField, material()) * p);
                              },
                              kSource, 2e-3),
                          material());
  const Matrix3d fromDisplacement =
      verification::hooke(differences(
                              [&](const Vector3d& x) {
                                return Vector3d(-kelvinTraction(x, kField, n, material()) * u);
                              },
                              kSource, 2e-3),
                          material());
  const Matrix3d D = kelvinStressFromTraction(kSource, kField, p, material());
  const Matrix3d S = kelvinStressFromDisplacement(kSource, kField, n, u, material());
  // As above, order 4 with a step of 1e-3 of the distance.
  EXPECT_LE((D - fromTraction).norm(), 1e-8 * D.norm());
  EXPECT_LE((S - fromDisplacement).norm(), 1e-8 * S.norm());
}

TEST_P(Kernels, StressKernelsHoldAlsoInTheIncompressibleLimit) {
  // By continuity in nu, nu = 0.5 must agree with the values that the differences confirm.
  const Material almost{0.1, GetParam() - 1e-7};
  const Vector3d p(0.3, -0.5, 0.8), u(-0.2, 0.9, 0.4), n = Vector3d(1, 2, -1).normalized();
  const Matrix3d D = kelvinStressFromTraction(kSource, kField, p, material());
  const Matrix3d S = kelvinStressFromDisplacement(kSource, kField, n, u, material());
  EXPECT_LE((D - kelvinStressFromTraction(kSource, kField, p, almost)).norm(), 1e-5 * D.norm());
  EXPECT_LE((S - kelvinStressFromDisplacement(kSource, kField, n, u, almost)).norm(),
            1e-5 * S.norm());
}

TEST_P(Kernels, DisplacementIsReciprocal) {
  const Matrix3d there = kelvinDisplacement(kSource, kField, material());
  EXPECT_LE((there - kelvinDisplacement(kField, kSource, material()).transpose()).norm(), 1e-14);
  EXPECT_LE((there - there.transpose()).norm(), 1e-14);
}

INSTANTIATE_TEST_SUITE_P(PoissonRatios, Kernels,
                         ::testing::Values(-0.5, 0.0, 0.3, 0.45, 0.49, 0.5));
// At nu = 0.5 the stress needs the pressure, which the displacement does not determine.
INSTANTIATE_TEST_SUITE_P(PoissonRatios, CompressibleKernels,
                         ::testing::Values(-0.5, 0.0, 0.3, 0.45, 0.49));

/// ∫ T dΓ over a closed mesh computed by `assemble`. Zero weights omit the free term, so at points
/// of the surface it is the principal value.
Matrix3d totalTraction(const BoundaryMesh& mesh, const Vector3d& x, double nu) {
  const auto operators =
      assemble<double>(mesh, TractionSlots(mesh), {{x, 0, Vector3d::Zero()}}, {0.1, nu}, {}, {});
  Matrix3d sum = Matrix3d::Zero();
  for (int k = 0; k < mesh.nodeCount(); ++k) sum += operators.H.view().middleCols<3>(3 * k);
  return sum;
}

// Every block has an error of at most 1e-7, and the absolute values of the blocks sum to about 2.
constexpr double kSumTolerance = 2e-7;

TEST(ClosedSurface, TractionOfAUnitForceBalancesItInsideAndVanishesOutside) {
  const Matrix3d identity = Matrix3d::Identity();
  const Vector3d low(-20, -15, 0), high(20, 15, 20);
  for (const double nu : {-0.5, 0.3, 0.5})
    for (const BoundaryMesh& mesh :
         {verification::boxMesh(low, high, 8, 6, 4), verification::sphereMesh(18, 6),
          verification::torusMesh(12, 6, 24, 12)}) {
      const Vector3d inside = Vector3d(12, 1, 0.5), outside(30, 4, 1), close(12.1, 0.2, 30);
      EXPECT_LE((totalTraction(mesh, inside, nu) + identity).norm(), kSumTolerance);
      EXPECT_LE(totalTraction(mesh, outside, nu).norm(), kSumTolerance);
      EXPECT_LE(totalTraction(mesh, close, nu).norm(), kSumTolerance);
    }
}

TEST(ClosedSurface, InsideAHollowBodyTheCavityIsOutside) {
  const BoundaryMesh mesh = verification::hollowSphereMesh(10, 25, 4, 6);
  EXPECT_LE(totalTraction(mesh, {1, 2, 3}, 0.3).norm(), kSumTolerance);
  EXPECT_LE((totalTraction(mesh, {0, 17, 3}, 0.3) + Matrix3d::Identity()).norm(), kSumTolerance);
}

TEST(ClosedSurface, OnTheSurfaceTheFreeTermRemains) {
  // On a face the free term is half the identity for any material; the point is not a node.
  const BoundaryMesh box = verification::boxMesh({-20, -15, 0}, {20, 15, 20}, 8, 6, 4);
  for (const double nu : {-0.5, 0.3, 0.5}) {
    const Vector3d face = box.point(3, Vector3d(0.5, 0.3, 0.2));
    EXPECT_LE((totalTraction(box, face, nu) + 0.5 * Matrix3d::Identity()).norm(), kSumTolerance);
    // The same holds on an edge between two triangles of one face.
    const Vector3d edge = box.point(3, Vector3d(0.5, 0.5, 0));
    EXPECT_LE((totalTraction(box, edge, nu) + 0.5 * Matrix3d::Identity()).norm(), kSumTolerance);
  }
}

/// Free term c of a node: minus the sum of the row's blocks except the diagonal block.
Matrix3d freeTerm(const BoundaryMesh& mesh, const Vector3d& at, double nu) {
  const auto operators =
      assemble<double>(mesh, TractionSlots(mesh), nodalCollocation(mesh), {0.1, nu}, {}, {});
  const int n = mesh.nodeCount();
  int node = 0;
  while ((mesh.nodes[node] - at).norm() > 1e-9) ++node;
  Matrix3d diagonal;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) diagonal(i, j) = operators.H.view()(i * n + node, 3 * node + j);
  return diagonal;
}

TEST(ClosedSurface, FreeTermOfABoxIsTheSolidAngleFraction) {
  // At a node of a box, the adjacent flat elements contribute no T that a rotation by 90 or 180
  // degrees would not cancel in the mean: the trace of the diagonal block equals the trace of c, 3
  // times 1/2, 1/4, 1/8.
  const BoundaryMesh box = verification::boxMesh({0, 0, 0}, {20, 20, 20}, 4, 4, 4);
  for (const double nu : {-0.5, 0.3, 0.5}) {
    EXPECT_NEAR(freeTerm(box, {10, 10, 0}, nu).trace(), 1.5, 3 * kSumTolerance);
    EXPECT_NEAR(freeTerm(box, {0, 10, 0}, nu).trace(), 0.75, 3 * kSumTolerance);
    EXPECT_NEAR(freeTerm(box, {0, 0, 0}, nu).trace(), 0.375, 3 * kSumTolerance);
  }
}

}  // namespace
}  // namespace palpa::bem
