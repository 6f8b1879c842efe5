// Reads a project, meshes its solid, holds it at its lowest part, presses on its top with boundary
// elements, and prints by how much that yields.
#include <cstdio>
#include <vector>

#include "bem/problem/reference_problem.h"
#include "modeling/mesh/mesh.h"
#include "modeling/project/project_file.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  using namespace palpa;
  const modeling::Project project = modeling::readProject(argv[1]);
  const modeling::SurfaceMesh surface = modeling::mesh(project.body, project.mesh);
  bem::BoundaryMesh mesh{surface.positions, surface.triangles, surface.smoothingGroupOfTriangle,
                         std::vector<int>(surface.triangles.size(), 0)};
  const auto [low, high] = modeling::boundingBox(project.body);
  for (int t = 0; t < mesh.triangleCount(); ++t)
    mesh.tags[t] =
        mesh.point(t, Eigen::Vector3d::Constant(1.0 / 3)).z() < 0.9 * low.z() + 0.1 * high.z() ? 1
                                                                                               : 0;
  const bem::TractionSlots slots(mesh);
  bem::BoundaryConditions conditions(mesh, slots);
  int top = 0;
  for (int slot = 0; slot < slots.count(); ++slot) {
    const auto& place = slots.slots[slot];
    if (place.tag == 1) conditions.ofSlot[slot] = bem::SlotCondition::kFixed;
    if (mesh.nodes[place.node].z() > mesh.nodes[slots.slots[top].node].z()) top = slot;
  }
  conditions.traction.segment<3>(3 * top) = Eigen::Vector3d(0, 0, -0.01);
  const auto problem = bem::makeDenseReferenceProblem(
      mesh, slots, conditions.ofSlot,
      {project.material.youngsModulus, project.material.poissonRatio}, {},
      bem::Precision::kAutomatic, {});
  const bem::BoundaryField field = problem->solveField(problem->dofs().knownField(conditions));
  const double yield = -field.u(3 * slots.slots[top].node + 2, 0);
  std::printf("%d nodes, the top yields by %.4f mm\n", mesh.nodeCount(), yield);
  return yield > 0 ? 0 : 1;
}
