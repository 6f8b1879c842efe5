#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "bem/contact_simulation.h"
#include "test_meshes.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using Kind = ContactTool::Kind;

constexpr double kRadius = 25;  // mm, of the body
constexpr Material kMaterial{0.1, 0.45};
const double kPlane = kMaterial.youngsModulus / (1 - kMaterial.poissonRatio * kMaterial.poissonRatio);  // E*, MPa
const Vector3d kTop(0, 0, kRadius);

/// A sphere fixed below z = -20 mm whose mesh becomes fine towards its top: the cube sphere under
/// the conformal map tan(θ/2) -> tan(θ/2) / finer, which leaves triangles similar to what they were.
BoundaryMesh refinedSphere(int n, double finer) {
  BoundaryMesh mesh = test::sphereMesh(kRadius, n);
  for (Vector3d& node : mesh.nodes) {
    const double across = std::hypot(node[0], node[1]);
    const double half = 0.5 * std::atan2(across, node[2]);  // θ/2
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
  ContactSurface surface;
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
    for (int round = 0; round < 10; ++round) {
      while (!simulation.missing().empty()) columns.compute(simulation.missing(), Job{});
      simulation.step(5);
    }
  }
};

double farCompliance(Body& body, double radius) {
  ContactSimulation simulation(body.surface, body.columns, body.base);
  const double force = 0.1;
  const auto id = simulation.begin({Kind::kForce, radius}, kTop, {0, 0, -force});
  body.settle(simulation);
  const double used = simulation.find(id)->patch[0].radius;
  const double integral = std::tgamma(6.0) * std::tgamma(0.5) /
                          (64 * std::pow(std::tgamma(3.5), 2) * std::tgamma(6.5));
  const double local = 48 * 48 * integral / (std::numbers::pi * kPlane * used);
  return -simulation.find(id)->displacement[2] / force - local;
}

TEST(Hertz, Explore) {
  const int n = std::getenv("HN") ? std::atoi(std::getenv("HN")) : 20;
  const double finer = std::getenv("HF") ? std::atof(std::getenv("HF")) : 5;
  const double ball = std::getenv("HB") ? std::atof(std::getenv("HB")) : 25;
  Body body(refinedSphere(n, finer));
  std::printf("n %d finest %g\n", body.mesh.nodeCount(),
              body.surface.narrowestMask(body.surface.tree().nearest(kTop)) / 1.25);
  const double effective = 1 / (1 / kRadius + 1 / ball);
  ContactSimulation simulation(body.surface, body.columns, body.base);
  const auto id = simulation.begin({Kind::kProbe, ball, 0}, kTop, kTop + Vector3d(0, 0, ball));
  for (double depth = 0.05; depth < 2; depth *= std::sqrt(2)) {
    simulation.set(id, {0, 0, kRadius + ball - depth});
    body.settle(simulation);
    const auto& contact = *simulation.find(id);
    const double force = -contact.force[2];
    const double a = std::cbrt(0.75 * force * effective / kPlane);
    const double far = farCompliance(body, std::sqrt(1.6) * a);
    const double local = std::pow(force / (4.0 / 3 * kPlane * std::sqrt(effective)), 2.0 / 3);
    // Solve depth = (F/k)^(2/3) + far F
    double expected = force;
    const double k = 4.0 / 3 * kPlane * std::sqrt(effective);
    for (int i = 0; i < 50; ++i) {
      const double g = std::pow(expected / k, 2.0 / 3) + far * expected - depth;
      const double dg = 2.0 / 3 * std::pow(expected / k, -1.0 / 3) / k + far;
      expected -= g / dg;
    }
    std::printf("depth %.4f F %.6f a %.3f far %.4f local %.4f masks %zu r %.3f expected %.6f error %.2f%% hertz %.6f res %g\n",
                depth, force, a, far, local, contact.patch.size(), contact.patch.empty()?0:contact.patch[0].radius, expected,
                100 * (force / expected - 1), k * std::pow(depth, 1.5), simulation.residual());
  }
}

}  // namespace
}  // namespace palpa::bem
