#include "app/core/boundary_setup.h"

#include <map>
#include <numeric>

#include "app/core/region_conditions.h"
#include "bem/results.h"

namespace palpa::app {
namespace {

using modeling::Support;

bem::BoundaryMesh boundaryMesh(const modeling::SurfaceMesh& surface) {
  bem::BoundaryMesh mesh{surface.positions, surface.triangles, surface.smoothingGroupOfTriangle,
                         RegionTags(surface).ofTriangle()};
  mesh.validate();
  return mesh;
}

void applySupports(const modeling::Project& project, const std::vector<int>& owner,
                   BoundarySetup& setup) {
  std::map<int, int> supportOfSlot;
  for (std::size_t t = 0; t < owner.size(); ++t)
    if (owner[t] >= 0)
      for (const int slot : setup.slots.ofCorner[t]) supportOfSlot[slot] = owner[t];
  std::map<int, PrescribedDisplacement> ofNode;
  for (const auto& [slot, index] : supportOfSlot) {
    const Support& support = project.supports[index];
    const auto& place = setup.slots.slots[slot];
    if (support.kind == Support::Kind::fixed) {
      setup.conditions.ofSlot[slot] = bem::SlotCondition::kFixed;
      ofNode[place.node].addFixed(support, setup.mesh.nodes[place.node]);
    } else {
      setup.conditions.ofSlot[slot] = bem::SlotCondition::kRoller;
      ofNode[place.node].addRoller(support, place.normal);
    }
  }
  for (const auto& [node, prescribed] : ofNode)
    setup.conditions.displacement.segment<3>(3 * node) = prescribed.value();
}

bem::SurfaceLoad surfaceLoad(const modeling::Load& load, std::vector<int> regionTriangles,
                             int triangleCount) {
  if (!modeling::regionOf(load)) {
    regionTriangles.resize(triangleCount);
    std::iota(regionTriangles.begin(), regionTriangles.end(), 0);
  }
  LoadTraction what = loadTraction(load);
  return {std::move(regionTriangles), std::move(what.traction), what.featureLength};
}

void applyLoads(const modeling::Project& project, const modeling::SurfaceMesh& surface,
                BoundarySetup& setup) {
  std::vector<int> all(setup.mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  std::size_t region = project.supports.size();
  for (const modeling::Load& load : project.loads) {
    std::vector<int> triangles;
    if (modeling::regionOf(load)) triangles = surface.trianglesOfRegion[region++];
    BoundarySetup::LoadPart part{load.name, {}, {}};
    part.traction =
        bem::projectTraction(setup.mesh, setup.slots,
                             surfaceLoad(load, std::move(triangles), setup.mesh.triangleCount()));
    part.resultant = bem::tractionResultant(setup.mesh, setup.slots, part.traction, all);
    setup.conditions.traction += part.traction;
    setup.loads.push_back(std::move(part));
  }
}

}  // namespace

BoundarySetup makeBoundarySetup(const modeling::Project& project,
                                const modeling::SurfaceMesh& surface) {
  bem::BoundaryMesh mesh = boundaryMesh(surface);
  bem::TractionSlots slots(mesh);
  bem::BoundaryConditions conditions(mesh, slots);
  BoundarySetup setup{std::move(mesh),
                      std::move(slots),
                      {project.material.youngsModulus, project.material.poissonRatio},
                      std::move(conditions),
                      {},
                      {}};
  for (std::size_t s = 0; s < project.supports.size(); ++s)
    setup.supports.push_back({project.supports[s].name, surface.trianglesOfRegion[s]});
  applySupports(project, supportOfTriangle(project, surface), setup);
  applyLoads(project, surface, setup);
  return setup;
}

}  // namespace palpa::app
