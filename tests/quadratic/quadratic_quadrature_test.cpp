#include "bem/quadratic/quadratic_quadrature.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "app/verification/exact/simple_meshes.h"
#include "quadratic_body.h"

namespace palpa::bem::test {
namespace {

using Eigen::Vector3d;

/// One six-node triangle; `bow`: offset of the middle nodes over the length of their edges.
std::unique_ptr<QuadraticSurface> randomElement(std::mt19937& random, double bow) {
  std::uniform_real_distribution<double> unit(0, 1), around(-1, 1);
  BoundaryMesh mesh;
  const double aspect = std::exp(1.5 * unit(random));
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {unit(random), (0.3 + unit(random)) / aspect, 0}};
  for (int k = 0; k < 3; ++k) {
    const Vector3d a = mesh.nodes[k], b = mesh.nodes[(k + 1) % 3];
    mesh.nodes.push_back((a + b) / 2 +
                         bow * (b - a).norm() *
                             Vector3d(0.3 * around(random), 0.3 * around(random), around(random)));
  }
  mesh.triangles = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
  mesh.smoothingGroups = mesh.tags = {0, 0, 0, 0};
  return std::make_unique<QuadraticSurface>(mesh, TractionSlots(mesh));
}

/// Largest error of the sums of an element over their largest value, for U and T apart. What a
/// translation takes away is subtracted from T at points of the element.
double errorAt(const QuadraticSurface& surface, const QuadraticQuadrature& quadrature,
               const QuadraticQuadrature& exact, const Vector3d& x, const ElementPlace* inside) {
  const auto sumsOf = [&](const QuadraticQuadrature& by) {
    const auto work = by.makeWorkspace();
    by.integrate(0, x, inside, *work);
    std::vector<double> basis(6, 0.0);
    if (inside) surface.evaluateBasis(*inside, basis);
    for (int k = kKernelSumsU; k < kKernelSums; ++k) {
      double total = 0;
      for (const KernelSums& sums : work->sums) total += sums.of[k];
      for (int f = 0; f < 6; ++f) work->sums[f].of[k] -= basis[f] * total;
    }
    return work->sums;
  };
  const auto found = sumsOf(quadrature), wanted = sumsOf(exact);
  double error[2] = {}, size[2] = {};
  for (int f = 0; f < 6; ++f)
    for (int k = 0; k < kKernelSums; ++k) {
      const int kind = k < kKernelSumsU ? 0 : 1;
      error[kind] = std::max(error[kind], std::abs(found[f].of[k] - wanted[f].of[k]));
      size[kind] = std::max(size[kind], std::abs(wanted[f].of[k]));
    }
  return std::max(error[0] / size[0], error[1] / size[1]);
}

TEST(QuadraticQuadrature, KeepsTheToleranceAtAllDistances) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(0, 1);
  for (const double tolerance : {1e-4, 1e-5, 1e-7}) {
    double worst = 0, worstInside = 0;
    for (int trial = 0; trial < 40; ++trial) {
      const auto surface = randomElement(random, trial % 4 * 0.03);
      const QuadraticQuadrature quadrature(*surface, tolerance), exact(*surface, 1e-3 * tolerance);
      for (double distance = 1e-3; distance < 30; distance *= 1.7) {
        const double u = unit(random), v = (1 - u) * unit(random);
        const SurfaceJet jet = surface->evaluate({0, u, v});
        Vector3d direction(normal(random), normal(random), normal(random));
        if (distance < 1) direction = jet.areaVector();
        const Vector3d x = jet.position + distance * direction.normalized();
        worst = std::max(worst, errorAt(*surface, quadrature, exact, x, nullptr));
      }
      for (const auto& [u, v] :
           {std::pair(0.0, 0.0), {1.0, 0.0}, {0.5, 0.5}, {0.5, 0.0}, {0.2, 0.3}, {0.9, 0.05}}) {
        const ElementPlace place{0, u, v};
        worstInside = std::max(worstInside, errorAt(*surface, quadrature, exact,
                                                    surface->evaluate(place).position, &place));
      }
    }
    std::printf("tolerance %.0e: apart %.1e, inside %.1e\n", tolerance, worst, worstInside);
    EXPECT_LE(worst, 5 * tolerance);
    EXPECT_LE(worstInside, 5 * tolerance);
  }
}

/// Of a flat triangle (Van Oosterom and Strackee 1983), positive on the side of its normal.
double solidAngle(const std::array<Vector3d, 3>& corners, const Vector3d& x) {
  const Vector3d a = corners[0] - x, b = corners[1] - x, c = corners[2] - x;
  return -2 * std::atan2(a.dot(b.cross(c)), a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                                                b.dot(c) * a.norm() + c.dot(a) * b.norm());
}

TEST(QuadraticQuadrature, TakesFewPointsOnSlivers) {
  constexpr double kTolerance = 1e-6;
  for (const double aspect : {10.0, 100.0, 1000.0, 10000.0}) {
    const std::array<Vector3d, 3> corners{Vector3d(0, 0, 0), Vector3d(1, 0, 0),
                                          Vector3d(0.4, 1 / aspect, 0)};
    BoundaryMesh mesh;
    mesh.nodes = {corners.begin(), corners.end()};
    for (int k = 0; k < 3; ++k) mesh.nodes.push_back((corners[k] + corners[(k + 1) % 3]) / 2);
    mesh.triangles = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
    mesh.smoothingGroups = mesh.tags = {0, 0, 0, 0};
    const QuadraticSurface surface(mesh, TractionSlots(mesh));
    const QuadraticQuadrature quadrature(surface, kTolerance);
    const auto work = quadrature.makeWorkspace();
    for (const double height : {0.03, 0.3, 3.0}) {
      const Vector3d x(0.5, 0.3 / aspect, height / aspect);
      // Quarters of quarters would be some millions for the longest.
      EXPECT_LT(quadrature.points(0, x, nullptr, *work).used, 30000) << aspect << ' ' << height;
      quadrature.integrate(0, x, nullptr, *work);
      double sum = 0;
      for (const KernelSums& sums : work->sums) sum += sums.of[6] + sums.of[8] + sums.of[11];
      EXPECT_NEAR(std::abs(sum), std::abs(solidAngle(corners, x)), 20 * kTolerance)
          << aspect << ' ' << height;
    }
  }
}

TEST(QuadraticQuadrature, SolidAngleOfAClosedSurface) {
  // The trace of the sums of T is the solid angle: 4 pi inside, 0 outside.
  const auto sphere = quadratic(verification::sphereMesh(25, 4), onSphere(25));
  const QuadraticSurface& surface = sphere->surface();
  const QuadraticQuadrature quadrature(surface, 1e-7);
  const auto work = quadrature.makeWorkspace();
  for (const auto& [x, angle] : {std::pair(Vector3d(3, -5, 8), 4 * std::numbers::pi),
                                 {Vector3d(0, 0, 24.9), 4 * std::numbers::pi},
                                 {Vector3d(0, 1, 25.2), 0.0}}) {
    double sum = 0;
    for (int e = 0; e < surface.elementCount(); ++e) {
      quadrature.integrate(e, x, nullptr, *work);
      for (const KernelSums& sums : work->sums) sum += sums.of[6] + sums.of[8] + sums.of[11];
    }
    EXPECT_NEAR(sum, angle, 1e-5);
  }
}

}  // namespace
}  // namespace palpa::bem::test
