#pragma once

#include <functional>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "bem/contact/contact_simulation.h"
#include "bem/dense/make_reference_problem.h"
#include "bem/triangle/triangle_contact_surface.h"

namespace palpa::bem::test {

/// A body of flat triangles that contacts touch, in double precision, without loads.
struct ContactBody {
  BoundaryMesh mesh;
  TractionSlots slots;
  std::shared_ptr<const ReferenceProblem> problem;
  BoundaryField base;
  std::unique_ptr<TriangleContactSurface> surface;
  std::unique_ptr<GreensColumns> columns;  ///< none is computed

  /// `conditionOf`: of the triangles with a tag.
  ContactBody(BoundaryMesh body, const Material& material,
              const std::function<SlotCondition(int tag)>& conditionOf)
      : mesh(std::move(body)), slots(mesh) {
    std::vector<SlotCondition> conditions;
    for (const auto& slot : slots.slots) conditions.push_back(conditionOf(slot.tag));
    problem =
        makeDenseReferenceProblem(mesh, slots, {conditions, material, {}, Precision::kDouble});
    base = {Eigen::VectorXd::Zero(3 * mesh.nodeCount()), Eigen::VectorXd::Zero(3 * slots.count())};
    surface = std::make_unique<TriangleContactSurface>(mesh, slots, problem->dofs());
    columns = std::make_unique<GreensColumns>(problem);
  }
  void computeAll() {
    std::vector<int> all(mesh.nodeCount());
    std::iota(all.begin(), all.end(), 0);
    columns->compute(all, Job{});
  }
};

/// Computes the columns that contacts wait for, until they rest.
inline void computeMissing(ContactSimulation& simulation, GreensColumns& columns) {
  for (int round = 0; round < 10 && !simulation.missing().empty(); ++round) {
    columns.compute(simulation.missing(), Job{});
    simulation.step(20);
  }
}

}  // namespace palpa::bem::test
