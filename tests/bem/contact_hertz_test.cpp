#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "bem/contact_simulation.h"
#include "bem/triangle_contact_surface.h"
#include "test_meshes.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using Kind = ContactTool::Kind;

constexpr double kRadius = 25;  // mm, of the body
constexpr Material kMaterial{0.1, 0.45};
const double kPlane =
    kMaterial.youngsModulus / (1 - kMaterial.poissonRatio * kMaterial.poissonRatio);  // E*, MPa
const Vector3d kTop(0, 0, kRadius);

/// A sphere fixed below z = -20 mm whose mesh becomes fine towards its top: the cube sphere under
/// the conformal map tan(θ/2) -> tan(θ/2) / finer, which leaves triangles similar to what they
/// were.
BoundaryMesh refinedSphere(int n, double finer) {
  BoundaryMesh mesh = test::sphereMesh(kRadius, n);
  for (Vector3d& node : mesh.nodes) {
    const double across = std::hypot(node[0], node[1]), half = 0.5 * std::atan2(across, node[2]);
    const double angle = 2 * std::atan2(std::sin(half), finer * std::cos(half));
    const double wider = across > 0 ? kRadius * std::sin(angle) / across : 0;
    node = {wider * node[0], wider * node[1], kRadius * std::cos(angle)};
  }
  for (int t = 0; t < mesh.triangleCount(); ++t)
    mesh.tags[t] = mesh.point(t, Vector3d::Constant(1.0 / 3))[2] < -20 ? 1 : 0;
  return mesh;
}

struct Body {
  BoundaryMesh mesh;
  TractionSlots slots;
  std::shared_ptr<const ReferenceProblem> problem;
  BoundaryField base;
  TriangleContactSurface surface;
  GreensColumns columns;

  explicit Body(BoundaryMesh made)
      : mesh(std::move(made)),
        slots(mesh),
        problem(solve(mesh, slots)),
        base{VectorXd::Zero(3 * mesh.nodeCount()), VectorXd::Zero(3 * slots.count())},
        surface(mesh, slots, problem->dofs()),
        columns(problem) {}
  static std::shared_ptr<const ReferenceProblem> solve(const BoundaryMesh& mesh,
                                                       const TractionSlots& slots) {
    std::vector<SlotCondition> conditions;
    for (const auto& slot : slots.slots)
      conditions.push_back(slot.tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction);
    return makeDenseReferenceProblem(mesh, slots, conditions, kMaterial, AssemblyOptions{},
                                     Precision::kAutomatic, Job{});
  }
  void settle(ContactSimulation& simulation) {
    for (int round = 0; round < 4; ++round) {
      while (!simulation.missing().empty()) columns.compute(simulation.missing(), Job{});
      simulation.step(5);
    }
  }
};

/// What a load on the top moves it by beyond a half-space, mm/N: the compliance of the whole sphere
/// and its support. Of a fingertip with a given force, so from masks and columns alone.
///
/// The mean displacement under (1 - ρ^2 / r^2)^2 on a half-space is that of its transform 48 J_3(k)
/// / k^3 with Boussinesq's 2 / (E* k): d = F / (π E* r) ∫ (48 J_3 / k^3)^2 dk, with Weber's and
/// Schafheitlin's ∫ J_3^2 k^-6 dk = Γ(6) Γ(1/2) / (2^6 Γ(7/2)^2 Γ(13/2)).
double farCompliance(Body& body, double radius) {
  ContactSimulation simulation(body.surface, body.columns, body.base);
  const auto id = simulation.begin({Kind::kForce, radius}, kTop, {0, 0, -1});
  body.settle(simulation);
  const double used = simulation.find(id)->patch[0].radius;
  const double integral =
      std::tgamma(6.0) * std::tgamma(0.5) / (64 * std::pow(std::tgamma(3.5), 2) * std::tgamma(6.5));
  const double halfSpace = 48 * 48 * integral / (std::numbers::pi * kPlane * used);
  return -simulation.find(id)->displacement[2] - halfSpace;
}

/// Hertz: two spheres approach by δ under F = 4/3 E* √R δ^1.5 with 1/R the sum of curvatures, over
/// a circle a = √(R δ) (K. L. Johnson, Contact Mechanics, 4.22-4.24; analytic.json has the same),
/// when both are half-spaces at the scale of a. Here the body is a sphere held at its bottom: the
/// whole sphere and its support yield by C F more, C = farCompliance() of a bump as wide as the
/// contact's pressure (the same mean of ρ^2: r^2 / 4 = 2 a^2 / 5). What is left is of the order (a
/// / R)^2.
TEST(Hertz, ARigidBallOnASphere) {
  Body body(refinedSphere(20, 5));  // n = 2,402; edges of 0.55 mm at the top
  for (const double ball : {25.0, 100.0}) {
    const double effective = 1 / (1 / kRadius + 1 / ball);
    const double factor = 4.0 / 3 * kPlane * std::sqrt(effective);
    ContactSimulation simulation(body.surface, body.columns, body.base);
    const auto id = simulation.begin({Kind::kProbe, ball, 0}, kTop, kTop + Vector3d(0, 0, ball));
    std::vector<double> forces, approaches;
    // Contact circles from twice the longest edges to a sixth of the sphere's radius.
    for (const double a : {1.2, 1.7, 2.2, 2.7, 3.2, 3.7, 4.2}) {
      SCOPED_TRACE(testing::Message() << "ball " << ball << " mm, a = " << a << " mm");
      const double approach = a * a / effective;
      const double far = farCompliance(body, std::sqrt(1.6) * a);
      const double expected = factor * std::pow(approach, 1.5);
      simulation.set(id, {0, 0, kRadius + ball - approach - far * expected});
      body.settle(simulation);
      ASSERT_TRUE(simulation.converged());
      const Vector3d force = simulation.find(id)->force;
      // The contact is 2 masks wide at first, which is what the error comes from; 7 at the end.
      EXPECT_NEAR(-force[2], expected, (a < 2 ? 0.04 : 0.015) * expected);
      EXPECT_LE(force.head<2>().norm(), 0.005 * force.norm());
      forces.push_back(-force[2]);
      approaches.push_back(approach);
    }
    // The exponent, by least squares over a range of 12 in depth and 43 in force.
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
}  // namespace palpa::bem
