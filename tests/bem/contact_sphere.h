#pragma once

#include <memory>
#include <numeric>
#include <vector>

#include "app/verification/exact/simple_meshes.h"
#include "bem/contact/contact_simulation.h"
#include "bem/dense/make_reference_problem.h"
#include "bem/triangle/triangle_contact_surface.h"

namespace palpa::bem::test {

inline constexpr Material kSoft{0.1, 0.45};

/// Silicone-like sphere of radius 25 mm, fixed below z = -20 mm, with all its columns.
struct ContactSphere {
  BoundaryMesh mesh;
  TractionSlots slots;
  std::shared_ptr<const ReferenceProblem> problem;
  BoundaryField base;
  std::unique_ptr<TriangleContactSurface> surface;
  std::unique_ptr<GreensColumns> columns;

  explicit ContactSphere(int n) : mesh(tagged(n)), slots(mesh) {
    std::vector<SlotCondition> conditions;
    for (const auto& slot : slots.slots)
      conditions.push_back(slot.tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction);
    problem = makeDenseReferenceProblem(mesh, slots, {conditions, kSoft, {}, Precision::kDouble});
    base = {Eigen::VectorXd::Zero(3 * mesh.nodeCount()), Eigen::VectorXd::Zero(3 * slots.count())};
    surface = std::make_unique<TriangleContactSurface>(mesh, slots, problem->dofs());
    columns = std::make_unique<GreensColumns>(problem);
    std::vector<int> all(mesh.nodeCount());
    std::iota(all.begin(), all.end(), 0);
    columns->compute(all, Job{});
  }
  static BoundaryMesh tagged(int n) {
    BoundaryMesh mesh = verification::sphereMesh(25, n);
    for (int t = 0; t < mesh.triangleCount(); ++t)
      mesh.tags[t] = mesh.point(t, Eigen::Vector3d::Constant(1.0 / 3))[2] < -20 ? 1 : 0;
    return mesh;
  }
  ContactSimulation simulation() const { return {*surface, *columns, base, kSoft}; }
};

inline const ContactSphere& sphere() {
  static const ContactSphere shared(10);  // 602 nodes, edges of 3.9 mm
  return shared;
}

inline const Eigen::Vector3d kTop(0, 0, 25), kSide(25, 0, 0);

}  // namespace palpa::bem::test
