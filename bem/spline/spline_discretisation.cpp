#include "bem/spline/spline_discretisation.h"

#include <utility>

#include "bem/element/element_interior.h"
#include "bem/spline/spline_body_force.h"
#include "bem/spline/spline_contact_surface.h"
#include "bem/spline/spline_equations.h"
#include "bem/spline/spline_nearest.h"
#include "bem/spline/spline_state.h"

namespace palpa::bem {

using Eigen::Vector3d;

SplineDiscretisation::SplineDiscretisation(BoundaryMesh mesh, SplineSurface surface,
                                           std::vector<SplineMesh::Triangle> triangles)
    : Discretisation(std::move(mesh)),
      surface_(std::move(surface)),
      tractions_(surface_),
      elements_(surface_, tractions_),
      splineMesh_(surface_, tractions_, Discretisation::mesh(), meshSlots(), std::move(triangles)) {
  std::vector<Entry> entries;
  for (const CollocationPlace& point : grevilleCollocation(surface_)) {
    const ElementPlace& place = point.places.front();
    addWeights({place.element, surface_.parameters(place).parameters},
               static_cast<int>(places_.size()), entries);
    places_.push_back(point.position);
  }
  placeWeights_.resize(surface_.coefficientCount(), surface_.coefficientCount());
  placeWeights_.setFromTriplets(entries.begin(), entries.end());
}

void SplineDiscretisation::addWeights(const SplineMesh::Point& at, int row,
                                      std::vector<Entry>& entries) const {
  std::vector<double> basis;
  surface_.evaluateBasis(at.element, at.parameters, basis);
  for (std::size_t f = 0; f < basis.size(); ++f)
    if (basis[f] != 0) entries.emplace_back(row, surface_.functions(at.element)[f], basis[f]);
}

DegreesOfFreedom SplineDiscretisation::degreesOfFreedom(
    const std::vector<SlotCondition>& conditions, const Material& material) const {
  return {tractions_.slots, conditions, material, surface_.boundingSize()};
}

void SplineDiscretisation::checkSolvable(const std::vector<SlotCondition>& conditions,
                                         const Material& material) const {
  bem::checkSolvable(surface_.controlPoints(), surface_.boundingSize(),
                     surface_.closedSurfaceCount(), conditions,
                     degreesOfFreedom(conditions, material), material);
}

BoundaryField SplineDiscretisation::valuesOnMesh(const BoundaryField& field) const {
  BoundaryField values;
  splineMesh_.displacements(field.u, values.u);
  splineMesh_.tractions(field.p, values.p);
  return values;
}

Discretisation::Weights SplineDiscretisation::displacementWeights(
    std::span<const SurfacePoint> places) const {
  std::vector<Entry> entries;
  for (std::size_t k = 0; k < places.size(); ++k)
    addWeights(splineMesh_.at(places[k]), static_cast<int>(k), entries);
  Weights weights(static_cast<Eigen::Index>(places.size()), displacementCount());
  weights.setFromTriplets(entries.begin(), entries.end());
  return weights;
}

Resultant SplineDiscretisation::resultant(const Eigen::VectorXd& p,
                                          std::span<const int> elements) const {
  return integrals().resultant(p, elements);
}

double SplineDiscretisation::strainEnergy(const Eigen::VectorXd& u,
                                          const Eigen::VectorXd& p) const {
  return integrals().strainEnergy(u, p);
}

std::vector<Eigen::Matrix3d> SplineDiscretisation::surfaceStress(const Eigen::VectorXd& u,
                                                                 const Eigen::VectorXd& p,
                                                                 const Material& material) const {
  return stress_.get(splineMesh_).stress(u, p, material);
}

Vector3d SplineDiscretisation::position(const SurfacePoint& place) const {
  return surfacePlaces(surface_, splineMesh_.at(place)).position;
}

Vector3d SplineDiscretisation::interpolate(const SurfacePoint& place,
                                           const Eigen::VectorXd& u) const {
  const SplineMesh::Point at = splineMesh_.at(place);
  return splineValue(surface_, at, surface_.functions(at.element), u);
}

Vector3d SplineDiscretisation::displacementAt(const SurfacePoint& place, const Eigen::VectorXd& u,
                                              const Eigen::VectorXd& p, const Bulk& bulk) const {
  return interpolate(place, u) + displacementDefect(place, u, p, bulk);
}

Vector3d SplineDiscretisation::tractionAt(const SurfacePoint& place,
                                          const Eigen::VectorXd& p) const {
  const SplineMesh::Point at = splineMesh_.at(place);
  return splineTraction(surface_, at, tractions_.ofFunction[at.element], p);
}

Vector3d SplineDiscretisation::displacementDefect(const SurfacePoint& place,
                                                  const Eigen::VectorXd& u,
                                                  const Eigen::VectorXd& p,
                                                  const Bulk& bulk) const {
  return results().displacementDefect(surfacePlaces(surface_, splineMesh_.at(place)), u, p, bulk);
}

BoundaryField SplineDiscretisation::estimatedError(const ReferenceProblem& problem,
                                                   const BoundaryField& field, const Bulk& bulk,
                                                   const Job& job) const {
  return bem::estimatedError(
      results(), problem, field, bulk, [](int) { return 1.0; }, job);
}

std::optional<InteriorState> SplineDiscretisation::interiorState(const Eigen::VectorXd& u,
                                                                 const Eigen::VectorXd& p,
                                                                 const Bulk& bulk,
                                                                 const Vector3d& point) const {
  return results().interiorState(u, p, bulk, point);
}

VolumeMoments SplineDiscretisation::volumeMoments() const {
  return bem::volumeMoments(surface_);
}

Eigen::VectorXd SplineDiscretisation::bodyForceTerm(const DegreesOfFreedom& dofs, const Bulk& bulk,
                                                    const Job& job) const {
  return results().bodyForceTerm(splineEquations(surface_, tractions_, dofs.extraSlots()), bulk,
                                 job);
}

BodyForceWork SplineDiscretisation::bodyForceWork(const Bulk& bulk) const {
  return bem::bodyForceWork(surface_, tractions_, bulk);
}

std::unique_ptr<InteriorEvaluator> SplineDiscretisation::makeInteriorEvaluator(
    std::vector<Vector3d> points, const Bulk& bulk, const Job& job) const {
  const SplineQuadrature& quadrature =
      interiorQuadrature_.get(surface_, ElementInterior::kTolerance, job);
  return std::make_unique<ElementInterior>(elements_, quadrature, bulk, std::move(points), job);
}

std::unique_ptr<ContactSurface> SplineDiscretisation::makeContactSurface(
    const DegreesOfFreedom& dofs) const {
  return std::make_unique<SplineContactSurface>(splineMesh_, dofs);
}

}  // namespace palpa::bem
