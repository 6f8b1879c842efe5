#include "bem/triangle/triangle_discretisation.h"

#include "bem/triangle/results.h"
#include "bem/triangle/triangle_body_force.h"
#include "bem/triangle/triangle_contact_surface.h"
#include "bem/triangle/triangle_interior.h"

namespace palpa::bem {

using Eigen::Vector3d;
using Eigen::VectorXd;

TriangleDiscretisation::TriangleDiscretisation(BoundaryMesh mesh)
    : Discretisation(std::move(mesh)) {}

TriangleDiscretisation::~TriangleDiscretisation() = default;

Discretisation::Weights TriangleDiscretisation::placeWeights() const {
  Weights weights(displacementCount(), displacementCount());
  weights.setIdentity();
  return weights;
}

DegreesOfFreedom TriangleDiscretisation::degreesOfFreedom(
    const std::vector<SlotCondition>& conditions, const Material& material) const {
  return {mesh(), slots(), conditions, material};
}

void TriangleDiscretisation::checkSolvable(const std::vector<SlotCondition>& conditions,
                                           const Material& material) const {
  bem::checkSolvable(mesh(), conditions, degreesOfFreedom(conditions, material), material);
}

void TriangleDiscretisation::write(const ByteSink& sink) const {
  writeList(sink, mesh().nodes);
  writeList(sink, mesh().triangles);
  writeList(sink, mesh().smoothingGroups);
  writeList(sink, mesh().tags);
}

Discretisation::Weights TriangleDiscretisation::displacementWeights(
    std::span<const SurfacePoint> places) const {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < places.size(); ++k)
    for (int corner = 0; corner < 3; ++corner)
      entries.emplace_back(static_cast<int>(k), mesh().triangles[places[k].triangle][corner],
                           places[k].weights[corner]);
  Weights weights(static_cast<Eigen::Index>(places.size()), displacementCount());
  weights.setFromTriplets(entries.begin(), entries.end());
  return weights;
}

Resultant TriangleDiscretisation::resultant(const VectorXd& p,
                                            std::span<const int> elements) const {
  return tractionResultant(mesh(), slots(), p, elements);
}

double TriangleDiscretisation::strainEnergy(const VectorXd& u, const VectorXd& p) const {
  return bem::strainEnergy(mesh(), slots(), u, p);
}

std::vector<Eigen::Matrix3d> TriangleDiscretisation::surfaceStress(const VectorXd& u,
                                                                   const VectorXd& p,
                                                                   const Material& material) const {
  return bem::surfaceStress(mesh(), slots(), u, p, material);
}

Vector3d TriangleDiscretisation::position(const SurfacePoint& place) const {
  return mesh().point(place.triangle, place.weights);
}

Vector3d TriangleDiscretisation::interpolate(const SurfacePoint& place, const VectorXd& u) const {
  Vector3d sum = Vector3d::Zero();
  for (int corner = 0; corner < 3; ++corner)
    sum += place.weights[corner] * u.segment<3>(3 * mesh().triangles[place.triangle][corner]);
  return sum;
}

Vector3d TriangleDiscretisation::displacementAt(const SurfacePoint& place, const VectorXd& u,
                                                const VectorXd& p, const Bulk& bulk) const {
  return surfaceDisplacement(mesh(), slots(), u, p, bulk, place, bodyForce(bulk));
}

Vector3d TriangleDiscretisation::tractionAt(const SurfacePoint& place, const VectorXd& p) const {
  Vector3d sum = Vector3d::Zero();
  for (int corner = 0; corner < 3; ++corner)
    sum += place.weights[corner] * p.segment<3>(3 * slots().ofCorner[place.triangle][corner]);
  return sum;
}

Vector3d TriangleDiscretisation::displacementDefect(const SurfacePoint& place, const VectorXd& u,
                                                    const VectorXd& p, const Bulk& bulk) const {
  return displacementAt(place, u, p, bulk) - interpolate(place, u);
}

BoundaryField TriangleDiscretisation::estimatedError(const ReferenceProblem&,
                                                     const BoundaryField& field, const Bulk&,
                                                     const Job&) const {
  return {Eigen::MatrixXd::Zero(field.u.rows(), field.u.cols()),
          Eigen::MatrixXd::Zero(field.p.rows(), field.p.cols())};
}

std::optional<InteriorState> TriangleDiscretisation::interiorState(const VectorXd& u,
                                                                   const VectorXd& p,
                                                                   const Bulk& bulk,
                                                                   const Vector3d& point) const {
  return bem::interiorState(mesh(), slots(), u, p, bulk, point, bodyForce(bulk));
}

const TriangleBodyForce* TriangleDiscretisation::bodyForce(const Bulk& bulk) const {
  return bulk.hasBodyForce() ? &bodyForce_.get(mesh()) : nullptr;
}

VolumeMoments TriangleDiscretisation::volumeMoments() const {
  return bem::volumeMoments(mesh());
}

VectorXd TriangleDiscretisation::bodyForceTerm(const DegreesOfFreedom& dofs, const Bulk& bulk,
                                               const Job& job) const {
  return bodyForce_.get(mesh()).term(dofs.collocationPoints(mesh(), slots()), bulk, job);
}

BodyForceWork TriangleDiscretisation::bodyForceWork(const Bulk& bulk) const {
  return bem::bodyForceWork(mesh(), slots(), bulk);
}

std::unique_ptr<InteriorEvaluator> TriangleDiscretisation::makeInteriorEvaluator(
    std::vector<Vector3d> points, const Bulk& bulk, const Job& job) const {
  return std::make_unique<TriangleInterior>(mesh(), slots(), bulk, std::move(points), job);
}

std::unique_ptr<ContactSurface> TriangleDiscretisation::makeContactSurface(
    const DegreesOfFreedom& dofs) const {
  return std::make_unique<TriangleContactSurface>(mesh(), slots(), dofs);
}

}  // namespace palpa::bem
