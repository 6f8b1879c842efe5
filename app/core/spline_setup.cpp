#include "app/core/spline_setup.h"

#include <map>
#include <numeric>

#include "app/core/region_conditions.h"
#include "app/core/spline_surface_of.h"
#include "app/core/support_borders.h"
#include "bem/spline/spline_projection.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using modeling::Support;

/// Supports that overlap, or that meet with different displacements, are found on the mesh: there
/// both kinds of elements say the same.
void checkSupports(const modeling::Project& project, const modeling::SurfaceMesh& mesh) {
  const std::vector<int> owner = supportOfTriangle(project, mesh);
  std::map<int, PrescribedDisplacement> ofNode;
  for (std::size_t t = 0; t < owner.size(); ++t)
    if (owner[t] >= 0 && project.supports[owner[t]].kind == Support::Kind::fixed)
      for (const int node : mesh.triangles[t])
        ofNode[node].addFixed(project.supports[owner[t]], mesh.positions[node]);
}

/// The surface cut into the parts of supports and loads.
bem::SplineSurface taggedSurface(const modeling::Project& project, const modeling::Solid& solid,
                                 RegionTags& tags) {
  bem::SplineSurface surface = splineSurfaceOf(solid);
  const std::vector<modeling::MeshRegion> regions = modeling::meshRegions(project);
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const auto region = static_cast<int>(r);
    surface = bem::withPart(
        surface, surfacePart(regions[r].where, solid),
        [&](int tag) { return tags.with(tag, region); },
        r < project.supports.size() ? bem::Tearing::kTorn : bem::Tearing::kWhole);
  }
  return surface;
}

std::vector<int> elementsIn(const bem::SplineSurface& surface, const RegionTags& tags, int region) {
  std::vector<int> elements;
  for (int e = 0; e < surface.elementCount(); ++e)
    if (tags.isIn(surface.elements()[e].tag, region)) elements.push_back(e);
  return elements;
}

void applySupports(const modeling::Project& project, const RegionTags& tags, SplineSetup& setup) {
  std::map<int, PrescribedDisplacement> ofCoefficient;
  const auto& slots = setup.tractions.slots.slots;
  for (std::size_t s = 0; s < slots.size(); ++s) {
    const auto& regions = tags.regions(slots[s].tag);
    const auto supportCount = static_cast<int>(project.supports.size());
    if (regions.empty() || regions.front() >= supportCount ||
        setup.surface.barelyReaches(slots[s].node, slots[s].tag, slots[s].smoothingGroup))
      continue;
    const Support& support = project.supports[regions.front()];
    if (support.kind == Support::Kind::fixed) {
      setup.conditions.ofSlot[s] = bem::SlotCondition::kFixed;
      ofCoefficient[slots[s].node].addFixed(support, setup.surface.controlPoints()[slots[s].node]);
    } else {
      setup.conditions.ofSlot[s] = bem::SlotCondition::kRoller;
      ofCoefficient[slots[s].node].addRoller(support, slots[s].normal);
    }
  }
  for (const auto& [coefficient, prescribed] : ofCoefficient)
    setup.conditions.displacement.segment<3>(3 * coefficient) = prescribed.value();
}

/// Of tractions in coefficients over the whole surface.
bem::Resultant resultantOf(const SplineSetup& setup, const Eigen::VectorXd& traction) {
  std::vector<int> all(setup.surface.elements().size());
  std::iota(all.begin(), all.end(), 0);
  bem::Resultant sum;
  std::vector<double> basis;
  bem::visitSplinePoints(
      setup.surface, all, 5, INFINITY,
      [&](const bem::SplinePlace& place, const bem::SplineJet& jet, double weight) {
        setup.surface.evaluateBasis(place, basis);
        Vector3d force = Vector3d::Zero();
        for (std::size_t f = 0; f < basis.size(); ++f)
          force += weight * basis[f] *
                   traction.segment<3>(3 * setup.tractions.ofFunction[place.element][f]);
        sum.force += force;
        sum.moment += jet.position.cross(force);
      });
  return sum;
}

void applyLoads(const modeling::Project& project, const RegionTags& tags, SplineSetup& setup) {
  auto region = static_cast<int>(project.supports.size());
  for (const modeling::Load& load : project.loads) {
    SplineSetup::LoadPart part;
    part.name = load.name;
    if (modeling::regionOf(load)) {
      part.elements = elementsIn(setup.surface, tags, region++);
    } else {
      part.elements.resize(setup.surface.elements().size());
      std::iota(part.elements.begin(), part.elements.end(), 0);
    }
    const LoadTraction what = loadTraction(load);
    part.traction = bem::projectTraction(setup.surface, setup.tractions, part.elements,
                                         what.traction, what.featureLength);
    part.resultant = resultantOf(setup, part.traction);
    setup.conditions.traction += part.traction;
    setup.loads.push_back(std::move(part));
  }
}

}  // namespace

SplineSetup makeSplineSetup(const modeling::Project& project, const modeling::SurfaceMesh& mesh,
                            const AnalysisNet& net) {
  checkSupports(project, mesh);
  const auto& design = std::get<modeling::Solid>(project.body);
  modeling::Solid solid = refined(design, net);
  RegionTags tags(mesh);
  bem::SplineSurface surface = taggedSurface(project, solid, tags);
  bem::SplineTractions tractions(surface);
  bem::BoundaryConditions conditions(surface.coefficientCount(), tractions.slots.count());
  SplineSetup setup{std::move(solid),
                    std::move(surface),
                    std::move(tractions),
                    tags.ofTriangle(),
                    splineTriangles(design, mesh),
                    std::move(conditions),
                    {},
                    {}};
  for (std::size_t s = 0; s < project.supports.size(); ++s)
    setup.supports.push_back(
        {project.supports[s].name, elementsIn(setup.surface, tags, static_cast<int>(s))});
  applySupports(project, tags, setup);
  applyLoads(project, tags, setup);
  return setup;
}

}  // namespace palpa::app
