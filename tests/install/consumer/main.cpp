// Reads a project, fixes the lowest part of its body, moves a place on top down by 1 mm, and prints
// the force that this takes.
#include <cstdio>
#include <memory>
#include <vector>

#include "bem/contact/bilateral_contact_solver.h"
#include "bem/contact/contact_surface.h"
#include "bem/dense/make_reference_problem.h"
#include "bem/triangle/triangle_discretisation.h"
#include "modeling/mesh/mesh.h"
#include "modeling/project/project_file.h"

using namespace palpa;
using Eigen::Vector3d;

// Triangles of the lowest tenth of the body have the tag 1, the others the tag 0.
bem::BoundaryMesh taggedMesh(const modeling::Project& project) {
  const modeling::SurfaceMesh surface = modeling::mesh(project.body, project.mesh);
  bem::BoundaryMesh mesh{surface.positions, surface.triangles, surface.smoothingGroupOfTriangle,
                         std::vector<int>(surface.triangles.size(), 0)};
  const auto [low, high] = modeling::boundingBox(project.body);
  for (int t = 0; t < mesh.triangleCount(); ++t)
    if (mesh.point(t, Vector3d::Constant(1.0 / 3)).z() < 0.9 * low.z() + 0.1 * high.z())
      mesh.tags[t] = 1;
  return mesh;
}

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const modeling::Project project = modeling::readProject(argv[1]);
  const bem::TriangleDiscretisation body(taggedMesh(project));

  // Fixed where the tag is 1, free of tractions elsewhere.
  bem::BoundaryConditions conditions(body.mesh(), body.slots());
  for (int slot = 0; slot < body.slots().count(); ++slot)
    if (body.slots().slots[slot].tag == 1) conditions.ofSlot[slot] = bem::SlotCondition::kFixed;

  // Assembles and factorises: the long step, done once.
  const bem::Material material{project.material.youngsModulus, project.material.poissonRatio};
  const std::shared_ptr<const bem::ReferenceProblem> problem =
      bem::makeDenseReferenceProblem(body, {conditions.ofSlot, material});

  // A contact with a mask of radius 5 mm at the highest point.
  const auto surface = body.makeContactSurface(problem->dofs());
  const auto [low, high] = modeling::boundingBox(project.body);
  const bem::ContactMask mask = bem::makeContactMask(*surface, Vector3d(0, 0, high.z()), 5.0);
  bem::BilateralContactSolver solver(problem, body.slots(),
                                     problem->solveField(problem->dofs().knownField(conditions)));
  solver.addGrab(mask, Vector3d(0, 0, -1));
  const Eigen::VectorXd force = solver.forces();
  const bem::BoundaryField field = solver.field(force);
  std::printf("%d nodes; force (%.3g, %.3g, %.3g) N; largest displacement %.3g mm\n",
              body.mesh().nodeCount(), force[0], force[1], force[2], field.u.cwiseAbs().maxCoeff());
  return force[2] < 0 ? 0 : 1;
}
