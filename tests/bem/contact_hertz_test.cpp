#include <gtest/gtest.h>

#include <cmath>

#include "app/verification/exact/simple_meshes.h"
#include "bem/dense/make_reference_problem.h"
#include "bem/triangle/triangle_contact_surface.h"
#include "hertz.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// Sphere fixed below z = -20 mm with a mesh that is refined towards its top: the cube sphere under
/// the conformal map tan(θ/2) -> tan(θ/2) / finer, which keeps the shape of the triangles.
BoundaryMesh refinedSphere(int n, double finer) {
  BoundaryMesh mesh = verification::sphereMesh(test::kHertzRadius, n);
  for (Vector3d& node : mesh.nodes) {
    const double across = std::hypot(node[0], node[1]), half = 0.5 * std::atan2(across, node[2]);
    const double angle = 2 * std::atan2(std::sin(half), finer * std::cos(half));
    const double wider = across > 0 ? test::kHertzRadius * std::sin(angle) / across : 0;
    node = {wider * node[0], wider * node[1], test::kHertzRadius * std::cos(angle)};
  }
  for (int t = 0; t < mesh.triangleCount(); ++t)
    mesh.tags[t] = mesh.point(t, Vector3d::Constant(1.0 / 3))[2] < -20 ? 1 : 0;
  return mesh;
}

/// Fixed where triangles have tag 1.
struct Body {
  BoundaryMesh mesh;
  TractionSlots slots{mesh};
  std::shared_ptr<const ReferenceProblem> problem;
  TriangleContactSurface surface;
  GreensColumns columns;
  BoundaryField base;

  explicit Body(BoundaryMesh made)
      : mesh(std::move(made)),
        problem(makeDenseReferenceProblem(
            mesh, slots, {conditionsOf(slots), test::kHertzMaterial, {}, Precision::kAutomatic})),
        surface(mesh, slots, problem->dofs()),
        columns(problem),
        base{VectorXd::Zero(3 * mesh.nodeCount()), VectorXd::Zero(3 * slots.count())} {}

  static std::vector<SlotCondition> conditionsOf(const TractionSlots& slots) {
    std::vector<SlotCondition> conditions;
    for (const auto& slot : slots.slots)
      conditions.push_back(slot.tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction);
    return conditions;
  }
  test::HertzBody forTest() { return {surface, columns, base}; }
};

TEST(Hertz, RigidBallOnASphere) {
  Body body(refinedSphere(20, 5));  // n = 2,402; edges of 0.55 mm at the top
  // Contact circles from twice the longest edges to a sixth of the sphere's radius: 2 masks wide at
  // first, which causes the error; 7 masks at the end.
  test::expectHertz(
      body.forTest(), {1.2, 1.7, 2.2, 2.7, 3.2, 3.7, 4.2},
      [](double a) { return a < 2 ? 0.04 : 0.015; }, 0.02);
}

/// Bar of 60 x 12 x 12 mm that is fixed at its left end.
BoundaryMesh bar(int along, int across) {
  BoundaryMesh mesh = verification::boxMesh({0, 0, 0}, {60, 12, 12}, along, across, across);
  for (int t = 0; t < mesh.triangleCount(); ++t)
    mesh.tags[t] = mesh.point(t, Vector3d::Constant(1.0 / 3))[0] < 1e-6 ? 1 : 0;
  return mesh;
}

/// The bar bends by up to 1 mm, while the contact is a tenth as wide as a mask.
TEST(Hertz, RigidBallOnABendingBar) {
  Body body(bar(20, 4));
  test::expectHertzOnSoftBody(body.forTest(), {52, 6, 12}, 8, {0.05, 0.2, 1}, 0.025);
}

/// The surface turns by the slope of a cantilever below the ball and moves along, 6 mm above the
/// middle of the bar: the ball touches the material nearer to the fixed end.
TEST(Hertz, ABallFollowsTheSurfaceThatTurns) {
  std::vector<double> forces;
  for (const int across : {4, 6}) {
    Body body(bar(5 * across, across));
    ContactSimulation simulation(body.surface, body.columns, body.base, test::kHertzMaterial);
    const auto id = simulation.begin({ContactTool::Kind::kBall, 8, 0}, {52, 6, 12}, {52, 6, 20});
    for (int k = 1; k <= 40; ++k) {
      simulation.set(id, {52, 6, 20 - 0.1 * k});
      while (!simulation.missing().empty()) body.columns.compute(simulation.missing(), Job{});
      simulation.step();
    }
    for (int k = 0; k < 40; ++k) {
      while (!simulation.missing().empty()) body.columns.compute(simulation.missing(), Job{});
      simulation.step();
    }
    const auto& contact = *simulation.find(id);
    std::printf("%d across: touches at %.3f mm, force %.5f N\n", across, contact.point.position[0],
                -contact.force[2]);
    constexpr double kSlope = 1.5 * 4 / 52;
    EXPECT_NEAR(contact.point.position[0], 52 - (8 + 6) * kSlope, 0.1);
    forces.push_back(-contact.force[2]);
  }
  EXPECT_NEAR(forces[0], forces[1], 0.03 * forces[1]);
}

}  // namespace
}  // namespace palpa::bem
