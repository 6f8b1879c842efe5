#include "app/core/setup/boundary_setup.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "app/core/setup/region_conditions.h"
#include "app/core/setup/spline_setup.h"
#include "bem/triangle/triangle_discretisation.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using modeling::Support;

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
    if (support.kind == Support::Kind::kFixed) {
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
    const auto& triangles = modeling::regionOf(load) ? surface.trianglesOfRegion[region++] : all;
    const LoadTraction what = loadTraction(load);
    setup.addLoad(load.name, bem::projectTraction(setup.mesh(), setup.meshSlots(),
                                                  {triangles, what.traction, what.featureLength}));
  }
}

bem::Material solverMaterial(const modeling::Material& material) {
  const auto& [name, youngsModulus, poissonRatio] = material;  // all fields
  return {youngsModulus, poissonRatio};
}

}  // namespace

BoundarySetup::BoundarySetup(const modeling::Project& project,
                             std::shared_ptr<const bem::Discretisation> surface)
    : discretisation(std::move(surface)),
      material(solverMaterial(project.material)),
      conditions(discretisation->displacementCount(), discretisation->slots().count()) {}

void BoundarySetup::addLoad(const std::string& name, Eigen::VectorXd traction) {
  std::vector<int> all(discretisation->elementCount());
  std::iota(all.begin(), all.end(), 0);
  conditions.traction += traction;
  const bem::Resultant resultant = discretisation->resultant(traction, all);
  const Vector3d place = meanPlace(*discretisation, traction);
  loads.push_back({name, std::move(traction), resultant, place});
}

BoundarySetup makeBoundarySetup(const ProjectGeometry& geometry,
                                const modeling::SurfaceMesh& surface) {
  if (geometry.usesSplines()) return makeSplineSetup(geometry, surface);
  const modeling::Project& project = geometry.project();
  BoundarySetup setup(project, std::make_shared<bem::TriangleDiscretisation>(
                                   boundaryMesh(surface, RegionTags(surface).ofTriangle())));
  for (std::size_t s = 0; s < project.supports.size(); ++s)
    setup.supports.push_back({project.supports[s].name, surface.trianglesOfRegion[s],
                              surface.trianglesOfRegion[s],
                              project.supports[s].kind == Support::Kind::kFixed});
  applySupports(project, supportOfTriangle(project, surface), setup);
  applyLoads(project, surface, setup);
  return setup;
}

}  // namespace palpa::app
