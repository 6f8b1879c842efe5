#include "app/core/boundary_setup.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "app/core/region_conditions.h"
#include "app/core/spline_setup.h"
#include "bem/spline/spline_discretisation.h"
#include "bem/triangle_discretisation.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using modeling::Support;

/// Half the width of a thumb's contact under a firm press, mm.
constexpr double kFingertipRadius = 6.0;

bem::BoundaryMesh boundaryMesh(const modeling::SurfaceMesh& surface, std::vector<int> tags) {
  bem::BoundaryMesh mesh{surface.positions, surface.triangles, surface.smoothingGroupOfTriangle,
                         std::move(tags)};
  mesh.validate();
  return mesh;
}

BoundarySetup emptySetup(const modeling::Project& project,
                         std::shared_ptr<const bem::Discretisation> discretisation) {
  bem::BoundaryConditions conditions(discretisation->displacementCount(),
                                     discretisation->slots().count());
  return {std::move(discretisation),
          nullptr,
          nullptr,
          {project.material.youngsModulus, project.material.poissonRatio},
          std::move(conditions),
          {},
          {}};
}

void applySupports(const modeling::Project& project, const std::vector<int>& owner,
                   BoundarySetup& setup) {
  std::map<int, int> supportOfSlot;
  for (std::size_t t = 0; t < owner.size(); ++t)
    if (owner[t] >= 0)
      for (const int slot : setup.meshSlots().ofCorner[t]) supportOfSlot[slot] = owner[t];
  std::map<int, PrescribedDisplacement> ofNode;
  for (const auto& [slot, index] : supportOfSlot) {
    const Support& support = project.supports[index];
    const auto& place = setup.meshSlots().slots[slot];
    if (support.kind == Support::Kind::fixed) {
      setup.conditions.ofSlot[slot] = bem::SlotCondition::kFixed;
      ofNode[place.node].addFixed(support, setup.mesh().nodes[place.node]);
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

/// Mean place of coefficients of traction, weighted by their size.
Vector3d meanPlace(const bem::Discretisation& on, const Eigen::VectorXd& traction) {
  Vector3d sum = Vector3d::Zero();
  double weights = 0;
  for (int slot = 0; slot < on.slots().count(); ++slot) {
    const double weight = traction.segment<3>(3 * slot).norm();
    sum += weight * on.places()[on.slots().slots[slot].node];
    weights += weight;
  }
  return weights > 0 ? Vector3d(sum / weights) : sum;
}

void applyLoads(const modeling::Project& project, const modeling::SurfaceMesh& surface,
                BoundarySetup& setup) {
  std::vector<int> all(setup.mesh().triangles.size());
  std::iota(all.begin(), all.end(), 0);
  std::size_t region = project.supports.size();
  for (const modeling::Load& load : project.loads) {
    std::vector<int> triangles;
    if (modeling::regionOf(load)) triangles = surface.trianglesOfRegion[region++];
    BoundarySetup::LoadPart part{load.name, {}, {}, Vector3d::Zero()};
    part.traction =
        bem::projectTraction(setup.mesh(), setup.meshSlots(),
                             surfaceLoad(load, std::move(triangles), setup.mesh().triangleCount()));
    part.resultant = setup.discretisation->resultant(part.traction, all);
    part.place = meanPlace(*setup.discretisation, part.traction);
    setup.conditions.traction += part.traction;
    setup.loads.push_back(std::move(part));
  }
}

BoundarySetup splineSetup(const modeling::Project& project, const modeling::SurfaceMesh& surface,
                          const AnalysisNet& net) {
  SplineSetup parts = makeSplineSetup(project, surface, net);
  auto splines = std::make_shared<const bem::SplineDiscretisation>(
      boundaryMesh(surface, std::move(parts.tagOfTriangle)), std::move(parts.surface),
      std::move(parts.tractions), std::move(parts.triangles));
  BoundarySetup setup = emptySetup(project, splines);
  setup.splines = splines;
  setup.analysisNet = std::make_shared<const modeling::Solid>(std::move(parts.solid));
  setup.conditions = std::move(parts.conditions);
  for (std::size_t s = 0; s < project.supports.size(); ++s)
    setup.supports.push_back({project.supports[s].name, surface.trianglesOfRegion[s],
                              std::move(parts.supports[s].elements),
                              project.supports[s].kind == Support::Kind::fixed});
  for (SplineSetup::LoadPart& load : parts.loads) {
    const Vector3d place = meanPlace(*splines, load.traction);
    setup.loads.push_back({std::move(load.name), std::move(load.traction), load.resultant, place});
  }
  return setup;
}

}  // namespace

AnalysisNet analysisNet(const modeling::Project& project) {
  return analysisNet(project, ElementSizes::of(project.mesh, fingertipRadius(project)));
}

bool usesSplines(const modeling::Project& project) {
  return std::holds_alternative<modeling::Solid>(project.body) &&
         project.mesh.engine != modeling::Engine::triangles;
}

double defaultTouchRadius(double bodySize) {
  return std::min(kFingertipRadius, 0.2 * bodySize / std::sqrt(3.0));
}

double fingertipRadius(const modeling::Project& project) {
  std::optional<double> narrowest;
  for (const modeling::Touch& touch : project.touches)
    if (touch.radius && !std::holds_alternative<modeling::TouchProbe>(touch.action))
      narrowest = std::min(narrowest.value_or(*touch.radius), *touch.radius);
  const auto [low, high] = modeling::boundingBox(project.body);
  return std::max(narrowest.value_or(0), defaultTouchRadius((high - low).norm()));
}

BoundarySetup makeBoundarySetup(const modeling::Project& project,
                                const modeling::SurfaceMesh& surface, const AnalysisNet* net) {
  if (usesSplines(project)) return splineSetup(project, surface, net ? *net : analysisNet(project));
  BoundarySetup setup =
      emptySetup(project, std::make_shared<bem::TriangleDiscretisation>(
                              boundaryMesh(surface, RegionTags(surface).ofTriangle())));
  for (std::size_t s = 0; s < project.supports.size(); ++s)
    setup.supports.push_back({project.supports[s].name, surface.trianglesOfRegion[s],
                              surface.trianglesOfRegion[s],
                              project.supports[s].kind == Support::Kind::fixed});
  applySupports(project, supportOfTriangle(project, surface), setup);
  applyLoads(project, surface, setup);
  return setup;
}

}  // namespace palpa::app
