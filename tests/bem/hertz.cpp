#include "hertz.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

namespace palpa::bem::test {
namespace {

using Eigen::Vector3d;
using Kind = ContactTool::Kind;

const double kPlane = kHertzMaterial.youngsModulus /
                      (1 - kHertzMaterial.poissonRatio * kHertzMaterial.poissonRatio);  // E*
const Vector3d kTop(0, 0, kHertzRadius);

void settle(const HertzBody& body, ContactSimulation& simulation) {
  for (int round = 0; round < 4; ++round) {
    while (!simulation.missing().empty()) body.columns.compute(simulation.missing(), Job{});
    simulation.step(5);
  }
}

/// Displacement at a place on top per unit load in addition to a half-space, mm/N: the compliance
/// of the whole body and its support. Computed for a fingertip with a given force, so from masks
/// and columns alone.
///
/// The mean displacement under (1 - ρ^2 / r^2)^2 on a half-space follows from its transform 48
/// J_3(k) / k^3 and Boussinesq's 2 / (E* k): d = F / (π E* r) ∫ (48 J_3 / k^3)^2 dk, with the
/// integral of Weber and Schafheitlin ∫ J_3^2 k^-6 dk = Γ(6) Γ(1/2) / (2^6 Γ(7/2)^2 Γ(13/2)).
double farCompliance(const HertzBody& body, const Vector3d& top, double radius) {
  ContactSimulation simulation(body.surface, body.columns, body.base, kHertzMaterial);
  const auto id = simulation.begin({Kind::kForce, radius}, top, {0, 0, -1});
  settle(body, simulation);
  const double used = simulation.find(id)->patch[0].radius;
  const double integral =
      std::tgamma(6.0) * std::tgamma(0.5) / (64 * std::pow(std::tgamma(3.5), 2) * std::tgamma(6.5));
  const double halfSpace = 48 * 48 * integral / (std::numbers::pi * kPlane * used);
  return -simulation.find(id)->displacement[2] - halfSpace;
}

/// Slope of the least-squares line through points.
double slope(const std::vector<double>& x, const std::vector<double>& y) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    sx += x[k];
    sy += y[k];
    sxx += x[k] * x[k];
    sxy += x[k] * y[k];
  }
  const auto count = static_cast<double>(x.size());
  return (count * sxy - sx * sy) / (count * sxx - sx * sx);
}

}  // namespace

void expectHertz(const HertzBody& body, const std::vector<double>& circles,
                 const std::function<double(double)>& tolerance, double exponentTolerance) {
  for (const double ball : {25.0, 100.0}) {
    const double effective = 1 / (1 / kHertzRadius + 1 / ball);
    const double factor = 4.0 / 3 * kPlane * std::sqrt(effective);
    ContactSimulation simulation(body.surface, body.columns, body.base, kHertzMaterial);
    const auto id = simulation.begin({Kind::kBall, ball, 0}, kTop, kTop + Vector3d(0, 0, ball));
    std::vector<double> forces, approaches;
    for (const double a : circles) {
      SCOPED_TRACE(testing::Message() << "ball " << ball << " mm, a = " << a << " mm");
      const double approach = a * a / effective;
      const double far = farCompliance(body, kTop, std::sqrt(1.6) * a);
      const double expected = factor * std::pow(approach, 1.5);
      simulation.set(id, {0, 0, kHertzRadius + ball - approach - far * expected});
      settle(body, simulation);
      ASSERT_TRUE(simulation.converged());
      const Vector3d force = simulation.find(id)->force;
      std::printf("ball %g, a %.1f mm: %zu masks, force %.2f %% off\n", ball, a,
                  simulation.find(id)->patch.size(), 100 * (-force[2] / expected - 1));
      EXPECT_NEAR(-force[2], expected, tolerance(a) * expected);
      EXPECT_LE(force.head<2>().norm(), 0.005 * force.norm());
      forces.push_back(std::log(-force[2]));
      approaches.push_back(std::log(approach));
    }
    EXPECT_NEAR(slope(approaches, forces), 1.5, exponentTolerance);
  }
}

void expectHertzOnSoftBody(const HertzBody& body, const Vector3d& top, double ball,
                           const std::vector<double>& approaches, double tolerance) {
  const double far = farCompliance(body, top, 0.6 * ball);
  ContactSimulation simulation(body.surface, body.columns, body.base, kHertzMaterial);
  const auto id = simulation.begin({Kind::kBall, ball, 0}, top, top + Vector3d(0, 0, ball));
  for (const double approach : approaches) {
    SCOPED_TRACE(testing::Message() << "approach " << approach << " mm");
    simulation.set(id, top + Vector3d(0, 0, ball - approach));
    settle(body, simulation);
    ASSERT_TRUE(simulation.converged());
    // Newton's method for a: approach = a^2 / R + far F, F = 4/3 E* a^3 / R.
    double a = std::sqrt(approach * ball);
    const double force = 4.0 / 3 * kPlane / ball;
    for (int k = 0; k < 60; ++k)
      a -= (a * a / ball + far * force * a * a * a - approach) /
           (2 * a / ball + 3 * far * force * a * a);
    const double expected = force * a * a * a;
    const auto& contact = *simulation.find(id);
    std::printf("approach %g, a %.2f mm, mask %.2f mm: force %.2f %% off\n", approach, a,
                contact.patch.empty() ? 0 : contact.patch.front().radius,
                100 * (-contact.force[2] / expected - 1));
    EXPECT_NEAR(-contact.force[2], expected, tolerance * expected);
  }
}

}  // namespace palpa::bem::test
