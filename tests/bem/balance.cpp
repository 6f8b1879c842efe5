#include "balance.h"
#include "bem/dense/make_reference_problem.h"
#include "bem/model/traction_projection.h"

#include <cstdio>

#include "app/verification/exact/simple_meshes.h"
#include "app/verification/exact/solved_body.h"
#include "bem/triangle/results.h"

namespace palpa::bem::test {
using namespace verification;
namespace {

using Eigen::Vector3d;

BalanceDefect balance(const char* name, BoundaryMesh mesh, int fixedTag, const Vector3d& center,
                      const Vector3d& direction, const Vector3d& support) {
  const Material material{0.1, 0.45};
  const TractionSlots slots(mesh);
  std::vector<SlotCondition> conditions;
  for (const auto& slot : slots.slots)
    conditions.push_back(slot.tag == fixedTag ? SlotCondition::kFixed : SlotCondition::kTraction);
  constexpr double kRadius = 12;
  const SurfaceLoad load{allTriangles(mesh),
                         [&](const Vector3d& x, const Vector3d&) {
                           const double s = (x - center).squaredNorm() / (kRadius * kRadius);
                           const double height = s < 1 ? (1 - s) * (1 - s) : 0;
                           return Vector3d(height * direction);
                         },
                         kRadius};
  BoundaryConditions given(mesh, slots);
  given.ofSlot = conditions;
  given.traction = projectTraction(mesh, slots, load);
  const auto problem =
      makeDenseReferenceProblem(mesh, slots, {conditions, material, {}, Precision::kAutomatic});
  const BoundaryField field = problem->solveField(problem->dofs().knownField(given));
  const Resultant applied = integrateLoad(mesh, load);
  const Resultant all = tractionResultant(mesh, slots, field.p.col(0), allTriangles(mesh));
  const double force = applied.force.norm();
  const double moment = (all.moment - support.cross(all.force)).norm();
  const BalanceDefect defect{mesh.nodeCount(), all.force.norm() / force,
                             moment / (force * (center - support).norm())};
  std::printf("%-8s n %5d  force defect %.2e  moment defect %.2e\n", name, defect.nodes,
              defect.force, defect.moment);
  return defect;
}

}  // namespace

BalanceDefect sphereBalance(int cells) {
  return balance("sphere",
                 retagged(sphereMesh(25, cells), 1, [](const Vector3d& x) { return x[2] < -20; }),
                 1, Vector3d(0.6, 0, 0.8) * 25, {-0.002, 0.001, -0.003}, {0, 0, -25});
}

BalanceDefect cylinderBalance(int around) {
  return balance("cylinder", gradedCylinderMesh(20, 60, around, around / 2), 1, {20, 0, 45},
                 {-0.003, 0.001, -0.001}, {0, 0, 0});
}

}  // namespace palpa::bem::test
