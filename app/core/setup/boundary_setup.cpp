#include "app/core/setup/boundary_setup.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "app/core/setup/load_setup.h"
#include "app/core/setup/region_conditions.h"
#include "app/core/setup/spline_setup.h"
#include "bem/quadratic/quadratic_discretisation.h"
#include "bem/triangle/triangle_discretisation.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using modeling::Support;

void applySupports(const modeling::Project& project, const RegionTags& tags, BoundarySetup& setup) {
  std::map<int, int> supportOfSlot;
  for (std::size_t t = 0; t < tags.ofTriangle().size(); ++t)
    if (const auto owner = tags.supportOf(tags.ofTriangle()[t]))
      for (const int slot : setup.meshSlots().ofCorner[t]) supportOfSlot[slot] = *owner;
  std::map<int, PrescribedDisplacement> ofNode;
  for (const auto& [slot, index] : supportOfSlot) {
    const Support& support = project.supports[index];
    const auto& place = setup.discretisation->slots().slots[slot];
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

/// Elements of some triangles: themselves, or the quadratic triangles of their quarters.
std::vector<int> elementsOf(const std::vector<int>& triangles, bool isQuadratic) {
  if (!isQuadratic) return triangles;
  std::vector<int> elements;
  for (const int t : triangles)
    if (elements.empty() || elements.back() != t / 4) elements.push_back(t / 4);
  return elements;
}

void applyLoads(const modeling::Project& project, const modeling::SurfaceMesh& surface,
                BoundarySetup& setup) {
  const auto* quadratic =
      dynamic_cast<const bem::QuadraticDiscretisation*>(setup.discretisation.get());
  std::vector<int> all(setup.mesh().triangles.size());
  std::iota(all.begin(), all.end(), 0);
  std::size_t region = project.supports.size();
  for (std::size_t k = 0; k < project.loads.size(); ++k) {
    const auto& triangles =
        modeling::regionOf(project.loads[k]) ? surface.trianglesOfRegion[region++] : all;
    addLoad(project, k, setup, [&](const LoadTraction& what) {
      if (quadratic)
        return quadratic->integrals().projectTraction(elementsOf(triangles, true), what.traction,
                                                      what.featureLength);
      return bem::projectTraction(setup.mesh(), setup.meshSlots(),
                                  {triangles, what.traction, what.featureLength});
    });
  }
}

bem::Material solverMaterial(const modeling::Material& material) {
  const auto& [name, youngsModulus, poissonRatio, density] = material;  // all fields
  return {youngsModulus, poissonRatio};
}

}  // namespace

BoundarySetup::BoundarySetup(const modeling::Project& project,
                             std::shared_ptr<const bem::Discretisation> surface)
    : discretisation(std::move(surface)),
      material(solverMaterial(project.material)),
      conditions(discretisation->displacementCount(), discretisation->slots().count()) {}

BoundarySetup::LoadPart& BoundarySetup::addLoad(const std::string& name, Eigen::VectorXd traction) {
  std::vector<int> all(discretisation->elementCount());
  std::iota(all.begin(), all.end(), 0);
  conditions.traction += traction;
  const bem::Resultant resultant = discretisation->resultant(traction, all);
  const Vector3d place = meanPlace(*discretisation, traction);
  loads.push_back({name, std::move(traction), resultant, place});
  return loads.back();
}

void BoundarySetup::addBodyForce(const std::string& name, const Vector3d& bodyForce) {
  conditions.bodyForce += bodyForce;
  const bem::VolumeMoments moments = discretisation->volumeMoments();
  loads.push_back({name, Eigen::VectorXd::Zero(conditions.traction.size()),
                   moments.resultant(bodyForce), moments.centroid()});
}

BoundarySetup makeBoundarySetup(const ProjectGeometry& geometry,
                                const modeling::SurfaceMesh& surface) {
  if (geometry.usesSplines()) return makeSplineSetup(geometry, surface);
  const modeling::Project& project = geometry.project();
  const RegionTags tags(project, surface);
  checkSupports(project, tags, surface);
  bem::BoundaryMesh mesh = boundaryMesh(surface, tags.ofTriangle());
  std::shared_ptr<const bem::Discretisation> discretisation;
  if (surface.isQuadratic)
    discretisation =
        std::make_shared<bem::QuadraticDiscretisation>(std::move(mesh), tags.ofSupports());
  else
    discretisation = std::make_shared<bem::TriangleDiscretisation>(std::move(mesh));
  BoundarySetup setup(project, std::move(discretisation));
  if (surface.isQuadratic) setup.engine = modeling::Engine::kQuadratic;
  for (std::size_t s = 0; s < project.supports.size(); ++s) {
    const std::vector<int> triangles = tags.trianglesIn(static_cast<int>(s));
    setup.supports.push_back({project.supports[s].name, triangles,
                              elementsOf(triangles, surface.isQuadratic),
                              project.supports[s].kind == Support::Kind::kFixed});
  }
  applySupports(project, tags, setup);
  applyLoads(project, surface, setup);
  return setup;
}

}  // namespace palpa::app
