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

TEST(Hertz, RigidBallOnASphere) {
  const BoundaryMesh mesh = refinedSphere(20, 5);  // n = 2,402; edges of 0.55 mm at the top
  const TractionSlots slots(mesh);
  std::vector<SlotCondition> conditions;
  for (const auto& slot : slots.slots)
    conditions.push_back(slot.tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction);
  const std::shared_ptr<const ReferenceProblem> problem = makeDenseReferenceProblem(
      mesh, slots, {conditions, test::kHertzMaterial, {}, Precision::kAutomatic});
  const TriangleContactSurface surface(mesh, slots, problem->dofs());
  GreensColumns columns(problem);
  const BoundaryField base{VectorXd::Zero(3 * mesh.nodeCount()), VectorXd::Zero(3 * slots.count())};
  // Contact circles from twice the longest edges to a sixth of the sphere's radius: 2 masks wide at
  // first, which causes the error; 7 masks at the end.
  test::expectHertz(
      {surface, columns, base}, {1.2, 1.7, 2.2, 2.7, 3.2, 3.7, 4.2},
      [](double a) { return a < 2 ? 0.04 : 0.015; }, 0.02);
}

}  // namespace
}  // namespace palpa::bem
