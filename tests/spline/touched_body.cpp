#include "touched_body.h"
#include "bem/dense/make_reference_problem.h"

#include <cmath>
#include <numeric>

#include "app/core/setup/to_spline_surface.h"
#include "bem/spline/surface_part.h"
#include "modeling/mesh/mesh.h"

namespace palpa::bem::test {

using Eigen::Vector3d;
using Eigen::VectorXd;

void TouchedBody::finish(std::shared_ptr<const ReferenceProblem> problem,
                         std::unique_ptr<ContactSurface> surface, const Material& material) {
  problem_ = std::move(problem);
  material_ = material;
  surface_ = std::move(surface);
  columns_ = std::make_unique<GreensColumns>(problem_);
  base_ = {VectorXd::Zero(problem_->dofs().nodalCount()),
           VectorXd::Zero(3 * problem_->dofs().slotCount())};
}

void TouchedBody::settle(ContactSimulation& simulation) {
  for (int round = 0; round < 4; ++round) {
    while (!simulation.missing().empty()) columns_->compute(simulation.missing(), Job{});
    simulation.step(5);
  }
}

void TouchedBody::computeAll() {
  std::vector<int> all(problem_->dofs().nodeCount());
  std::iota(all.begin(), all.end(), 0);
  columns_->compute(all, Job{});
}

namespace {

int lowestPatch(const modeling::Solid& solid) {
  int best = 0;
  double lowest = INFINITY;
  for (std::size_t p = 0; p < solid.patches().size(); ++p) {
    double sum = 0, count = 0;
    for (const auto& row : solid.patches()[p].net)
      for (const int point : row) {
        sum += solid.controlPoints()[point].z();
        ++count;
      }
    if (sum / count >= lowest) continue;
    lowest = sum / count;
    best = static_cast<int>(p);
  }
  return best;
}

SplineSurface fixedSurface(const modeling::Solid& solid, FixedBelow fixedBelow) {
  SplineSurface surface = app::splineSurfaceOf(solid);
  if (fixedBelow)
    return withPart(
        surface, [fixedBelow](const Vector3d& x) { return x.z() - *fixedBelow; }, 1,
        Tearing::kRoots);
  const int patch = lowestPatch(solid);
  for (int e = 0; e < surface.elementCount(); ++e)
    if (surface.elements()[e].patch == patch) surface.setTag(e, 1);
  return surface;
}

modeling::SurfaceMesh meshOf(const modeling::Solid& solid, FixedBelow fixedBelow, double edgeLength,
                             int levels) {
  modeling::MeshSettings settings;
  settings.edgeLength = edgeLength;
  settings.refinementLevels = levels;
  settings.refineAtBorders = settings.refineAtSharpEdges = levels > 0;
  const std::vector<modeling::MeshRegion> regions{
      {"base", fixedBelow
                   ? modeling::Region::below(Vector3d::UnitZ(), *fixedBelow)
                   : modeling::Region::ofPatches({solid.patches()[lowestPatch(solid)].name})}};
  return modeling::mesh(solid, settings, regions);
}

BoundaryMesh tagged(const modeling::SurfaceMesh& triangles) {
  BoundaryMesh mesh{triangles.positions, triangles.triangles, triangles.smoothingGroupOfTriangle,
                    std::vector<int>(triangles.triangles.size(), 0)};
  for (const int t : triangles.trianglesOfRegion[0]) mesh.tags[t] = 1;
  return mesh;
}

}  // namespace

SplineTouched::SplineTouched(const modeling::Solid& solid, FixedBelow fixedBelow,
                             const Material& material, double edgeLength, Precision precision)
    : splines(fixedSurface(solid, fixedBelow)), tractions(splines) {
  const modeling::SurfaceMesh triangles = meshOf(solid, fixedBelow, edgeLength, 0);
  mesh = tagged(triangles);
  meshSlots = TractionSlots(mesh);
  onMesh = std::make_unique<SplineMesh>(
      splines, tractions, mesh, meshSlots,
      app::splineTriangles(solid, modeling::SurfaceEvaluator(solid), triangles));
  std::vector<SlotCondition> conditions;
  for (const auto& slot : tractions.slots.slots)
    conditions.push_back(slot.tag == 1 &&
                                 !splines.barelyReaches(slot.node, slot.tag, slot.smoothingGroup)
                             ? SlotCondition::kFixed
                             : SlotCondition::kTraction);
  std::shared_ptr<const ReferenceProblem> problem =
      makeDenseReferenceProblem(splines, tractions, {conditions, material, {1e-5}, precision});
  auto surface = std::make_unique<SplineContactSurface>(*onMesh, problem->dofs());
  contacts = surface.get();
  finish(problem, std::move(surface), material);
}

TriangleTouched::TriangleTouched(BoundaryMesh made, const Material& material, Precision precision)
    : mesh(std::move(made)), slots(mesh) {
  std::vector<SlotCondition> conditions;
  for (const auto& slot : slots.slots)
    conditions.push_back(slot.tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction);
  std::shared_ptr<const ReferenceProblem> problem =
      makeDenseReferenceProblem(mesh, slots, {conditions, material, {}, precision});
  auto surface = std::make_unique<TriangleContactSurface>(mesh, slots, problem->dofs());
  finish(problem, std::move(surface), material);
}

BoundaryMesh fittedMesh(const modeling::Solid& solid, FixedBelow fixedBelow, double edgeLength,
                        int levels) {
  return tagged(meshOf(solid, fixedBelow, edgeLength, levels));
}

}  // namespace palpa::bem::test
