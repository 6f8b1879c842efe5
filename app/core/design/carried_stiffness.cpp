#include "app/core/design/carried_stiffness.h"

#include "app/core/setup/boundary_setup.h"
#include "bem/base/error.h"
#include "bem/dense/make_reference_problem.h"
#include "modeling/editing/nearest_on_patches.h"
#include "modeling/mesh/mesh.h"
#include "modeling/mesh/mesh_follow.h"

namespace palpa::app {

using Eigen::Vector3d;

namespace {

// Small motions are meant: thin triangles of a graded mesh may become a little thinner.
constexpr modeling::FollowLimits kLimits{.smallestAngle = 1};

BoundarySetup movedSetup(const modeling::Project& project, const modeling::Project& moved,
                         const TouchModel& model, const Job& job) {
  if (model.setup().splines) {
    const ProjectGeometry geometry(moved, ProjectGeometry(project).refinement());
    return makeBoundarySetup(geometry,
                             modeling::mesh(moved.body, moved.mesh, geometry.regions(), job));
  }
  const ProjectGeometry geometry(moved);
  auto followed = modeling::followSolid(model.surface(), std::get<modeling::Solid>(project.body),
                                        std::get<modeling::Solid>(moved.body), geometry.regions(),
                                        kLimits, job);
  if (!followed.update)
    throw bem::SolverError(bem::SolverError::Kind::kBadMesh,
                           "the moved body must be meshed again, because " + followed.remeshReason +
                               "; move the points less");
  return makeBoundarySetup(geometry, followed.update->mesh);
}

}  // namespace

modeling::Project withControlPoints(const modeling::Project& project,
                                    std::vector<Vector3d> points) {
  modeling::Project moved = project;
  moved.body = std::get<modeling::Solid>(project.body).withControlPoints(std::move(points));
  return moved;
}

StiffnessRule carriedRule(const StiffnessRule& rule, const modeling::Solid& from,
                          const modeling::Solid& to) {
  StiffnessRule carried = rule;
  modeling::NearestOnPatches nearest(from);
  for (StiffnessRule::Mask& mask : carried.masks) {
    const modeling::SurfaceSum sum = nearest.of(mask.at);
    mask.at.setZero();
    for (const auto& [point, weight] : sum) mask.at += weight * to.controlPoints()[point];
  }
  return carried;
}

double movedStiffness(const modeling::Project& project, const TouchModel& model,
                      const StiffnessRule& rule, std::vector<Vector3d> points, const Job& job) {
  const modeling::Project moved = withControlPoints(project, std::move(points));
  const BoundarySetup setup = movedSetup(project, moved, model, job);
  const bem::AssemblyOptions assembly = setup.engine == modeling::Engine::kTriangles
                                            ? bem::AssemblyOptions{}
                                            : bem::AssemblyOptions{1e-3 * project.mesh.accuracy};
  const auto problem = bem::makeDenseReferenceProblem(
      *setup.discretisation, {setup.conditions.ofSlot, setup.material, assembly}, job);
  const auto surface = setup.discretisation->makeContactSurface(problem->dofs());
  return contactStiffness(*problem, *surface,
                          carriedRule(rule, std::get<modeling::Solid>(project.body),
                                      std::get<modeling::Solid>(moved.body)),
                          job)
      .value;
}

}  // namespace palpa::app
