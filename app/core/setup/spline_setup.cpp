#include "app/core/setup/spline_setup.h"

#include <map>
#include <numeric>

#include "app/core/setup/load_setup.h"
#include "app/core/setup/region_conditions.h"
#include "app/core/setup/support_borders.h"
#include "app/core/setup/to_spline_surface.h"
#include "bem/spline/spline_discretisation.h"
#include "bem/spline/spline_projection.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using modeling::Support;

/// The surface of the refined `solid`, cut into the parts of supports and loads.
bem::SplineSurface taggedSurface(const ProjectGeometry& geometry, const modeling::Solid& solid,
                                 RegionTags& tags) {
  bem::SplineSurface surface = splineSurfaceOf(solid, geometry.smoothingGroups());
  const std::vector<modeling::MeshRegion>& regions = geometry.regions();
  const bem::Tearing tearing =
      geometry.refinement().hasRoots ? bem::Tearing::kRoots : bem::Tearing::kTorn;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const auto region = static_cast<int>(r);
    surface = bem::withPart(
        surface, surfacePart(regions[r].where, solid),
        [&](int tag) { return tags.with(tag, region); },
        r < geometry.project().supports.size() ? tearing : bem::Tearing::kWhole);
  }
  return surface;
}

std::vector<int> elementsIn(const bem::SplineSurface& surface, const RegionTags& tags, int region) {
  std::vector<int> elements;
  for (int e = 0; e < surface.elementCount(); ++e)
    if (tags.isIn(surface.elements()[e].tag, region)) elements.push_back(e);
  return elements;
}

void applySupports(const modeling::Project& project, const RegionTags& tags, BoundarySetup& setup) {
  const bem::SplineSurface& surface = setup.splines->surface();
  std::map<int, PrescribedDisplacement> ofCoefficient;
  const auto& slots = setup.splines->slots().slots;
  for (std::size_t s = 0; s < slots.size(); ++s) {
    const auto owner = tags.supportOf(slots[s].tag);
    if (!owner || surface.barelyReaches(slots[s].node, slots[s].tag, slots[s].smoothingGroup))
      continue;
    const Support& support = project.supports[*owner];
    if (support.kind == Support::Kind::kFixed) {
      setup.conditions.ofSlot[s] = bem::SlotCondition::kFixed;
      ofCoefficient[slots[s].node].addFixed(support, surface.controlPoints()[slots[s].node]);
    } else {
      setup.conditions.ofSlot[s] = bem::SlotCondition::kRoller;
      ofCoefficient[slots[s].node].addRoller(support, slots[s].normal);
    }
  }
  for (const auto& [coefficient, prescribed] : ofCoefficient)
    setup.conditions.displacement.segment<3>(3 * coefficient) = prescribed.value();
}

void applyLoads(const modeling::Project& project, const RegionTags& tags, BoundarySetup& setup) {
  const bem::SplineSurface& surface = setup.splines->surface();
  auto region = static_cast<int>(project.supports.size());
  for (std::size_t k = 0; k < project.loads.size(); ++k) {
    std::vector<int> elements(surface.elements().size());
    std::iota(elements.begin(), elements.end(), 0);
    if (modeling::regionOf(project.loads[k])) elements = elementsIn(surface, tags, region++);
    addLoad(project, k, setup, [&](const LoadTraction& what) {
      return bem::projectTraction(surface, setup.splines->tractions(), elements, what.traction,
                                  what.featureLength);
    });
  }
}

}  // namespace

BoundarySetup makeSplineSetup(const ProjectGeometry& geometry, const modeling::SurfaceMesh& mesh) {
  const modeling::Project& project = geometry.project();
  RegionTags tags(project, mesh);
  checkSupports(project, tags, mesh);
  auto solid =
      std::make_shared<const modeling::Solid>(refined(geometry.solid(), geometry.refinement()));
  bem::SplineSurface surface = taggedSurface(geometry, *solid, tags);
  const auto splines = std::make_shared<const bem::SplineDiscretisation>(
      boundaryMesh(mesh, tags.ofTriangle()), std::move(surface),
      splineTriangles(geometry.solid(), geometry.evaluator(), mesh));
  BoundarySetup setup(project, splines);
  setup.splines = splines;
  setup.engine = modeling::Engine::kSplines;
  setup.refinedSolid = std::move(solid);
  for (std::size_t s = 0; s < project.supports.size(); ++s)
    setup.supports.push_back({project.supports[s].name, tags.trianglesIn(static_cast<int>(s)),
                              elementsIn(splines->surface(), tags, static_cast<int>(s)),
                              project.supports[s].kind == Support::Kind::kFixed});
  applySupports(project, tags, setup);
  applyLoads(project, tags, setup);
  return setup;
}

}  // namespace palpa::app
