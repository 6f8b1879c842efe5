#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "modeling/shapes/primitives.h"
#include "modeling/solid/knot_operations.h"
#include "touched_body.h"

namespace palpa::bem::test {
namespace {

using Eigen::Vector3d;
using Kind = ContactTool::Kind;

constexpr double kRadius = 25;  // mm, of the body
constexpr Material kMaterial{0.1, 0.45};
const double kPlane =
    kMaterial.youngsModulus / (1 - kMaterial.poissonRatio * kMaterial.poissonRatio);  // E*, MPa
const Vector3d kTop(0, 0, kRadius);

/// The patch that contains the top of the sphere.
int topPatch(const modeling::Solid& solid) {
  int best = 0;
  double highest = -INFINITY;
  for (std::size_t p = 0; p < solid.patches().size(); ++p) {
    double sum = 0, count = 0;
    for (const auto& row : solid.patches()[p].net)
      for (const int point : row) {
        sum += solid.controlPoints()[point].z();
        ++count;
      }
    if (sum / count > highest) {
      highest = sum / count;
      best = static_cast<int>(p);
    }
  }
  return best;
}

/// Halves the spans that reach into a part of the parameters' range around its middle, in both
/// directions of a patch.
modeling::Solid refinedAround(modeling::Solid solid, int patch, double part) {
  for (int d = 0; d < 2; ++d) {
    const std::vector<double> knots = solid.patches()[patch].knots[d];
    const double middle = (knots.front() + knots.back()) / 2, size = knots.back() - knots.front();
    for (std::size_t k = 0; k + 1 < knots.size(); ++k)
      if (knots[k] < knots[k + 1] && knots[k] < middle + part / 2 * size - 1e-9 &&
          knots[k + 1] > middle - part / 2 * size + 1e-9)
        solid = modeling::insertKnot(solid, {patch, d}, (knots[k] + knots[k + 1]) / 2);
  }
  return solid;
}

/// Mean displacement of a fingertip's mask on a half-space per force, mm/N: see the test of
/// triangles (tests/bem/contact_hertz_test.cpp), whose far compliance this is as well.
double farCompliance(TouchedBody& body, double radius) {
  ContactSimulation simulation = body.simulation();
  const auto id = simulation.begin({Kind::kForce, radius}, kTop, {0, 0, -1});
  body.settle(simulation);
  const double used = simulation.find(id)->patch[0].radius;
  const double integral =
      std::tgamma(6.0) * std::tgamma(0.5) / (64 * std::pow(std::tgamma(3.5), 2) * std::tgamma(6.5));
  const double halfSpace = 48 * 48 * integral / (std::numbers::pi * kPlane * used);
  return -simulation.find(id)->displacement[2] - halfSpace;
}

/// F = 4/3 E* √R δ^1.5, as in the test of triangles, with their tolerances.
TEST(SplineHertz, ARigidBallOnASphere) {
  modeling::Solid solid = modeling::makeSphere(kRadius, 7);
  const int patch = topPatch(solid);
  for (const double part : {0.5, 0.25, 0.25, 0.15}) solid = refinedAround(solid, patch, part);
  SplineTouched body(solid, -20, kMaterial, 3, Precision::kAutomatic);
  const SurfacePoint top = body.surface().nearest(kTop);
  std::printf("n = %d, narrowest mask %.2f mm\n", body.splines.coefficientCount(),
              body.surface().narrowestMask(top));
  for (const double ball : {25.0, 100.0}) {
    const double effective = 1 / (1 / kRadius + 1 / ball);
    const double factor = 4.0 / 3 * kPlane * std::sqrt(effective);
    ContactSimulation simulation = body.simulation();
    const auto id = simulation.begin({Kind::kProbe, ball, 0}, kTop, kTop + Vector3d(0, 0, ball));
    std::vector<double> forces, approaches;
    for (const double a : {1.2, 1.7, 2.2, 2.7, 3.2, 3.7, 4.2}) {
      SCOPED_TRACE(testing::Message() << "ball " << ball << " mm, a = " << a << " mm");
      const double approach = a * a / effective;
      const double far = farCompliance(body, std::sqrt(1.6) * a);
      const double expected = factor * std::pow(approach, 1.5);
      simulation.set(id, {0, 0, kRadius + ball - approach - far * expected});
      body.settle(simulation);
      ASSERT_TRUE(simulation.converged());
      const Vector3d force = simulation.find(id)->force;
      std::printf("ball %g, a %.1f mm: %zu masks, force %.3f %% off\n", ball, a,
                  simulation.find(id)->patch.size(), 100 * (-force[2] / expected - 1));
      EXPECT_NEAR(-force[2], expected, (a < 2 ? 0.04 : 0.015) * expected);
      EXPECT_LE(force.head<2>().norm(), 0.005 * force.norm());
      forces.push_back(-force[2]);
      approaches.push_back(approach);
    }
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    const auto count = static_cast<double>(forces.size());
    for (std::size_t k = 0; k < forces.size(); ++k) {
      const double x = std::log(approaches[k]), y = std::log(forces[k]);
      sx += x;
      sy += y;
      sxx += x * x;
      sxy += x * y;
    }
    EXPECT_NEAR((count * sxy - sx * sy) / (count * sxx - sx * sx), 1.5, 0.02);
  }
}

}  // namespace
}  // namespace palpa::bem::test
