#include "bem/quadratic/quadratic_discretisation.h"

#include <limits>

#include "bem/element/element_interior.h"
#include "bem/element/gather.h"
#include "bem/model/body_force.h"
#include "bem/quadratic/quadratic_assembly.h"
#include "bem/quadratic/quadratic_contact_surface.h"
#include "bem/triangle/results.h"

namespace palpa::bem {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

QuadraticDiscretisation::QuadraticDiscretisation(BoundaryMesh mesh,
                                                 const std::vector<int>& supportTags)
    : Discretisation(std::move(mesh)),
      surface_(this->mesh(), meshSlots(), supportTags),
      slots_(withCurvedNormals(meshSlots(), surface_)) {}

Discretisation::Weights QuadraticDiscretisation::placeWeights() const {
  Weights weights(displacementCount(), displacementCount());
  weights.setIdentity();
  return weights;
}

DegreesOfFreedom QuadraticDiscretisation::degreesOfFreedom(
    const std::vector<SlotCondition>& conditions, const Material& material) const {
  return {slots_, conditions, material, surface_.boundingSize()};
}

void QuadraticDiscretisation::checkSolvable(const std::vector<SlotCondition>& conditions,
                                            const Material& material) const {
  bem::checkSolvable(mesh(), conditions, degreesOfFreedom(conditions, material), material);
}

void QuadraticDiscretisation::write(const ByteSink& sink) const {
  // Linear triangles on the same mesh are another problem.
  writeList(sink, std::vector<int>{2});
  writeList(sink, mesh().nodes);
  writeList(sink, mesh().triangles);
  writeList(sink, mesh().smoothingGroups);
  writeList(sink, mesh().tags);
  std::vector<int> onBorder;
  for (int node = 0; node < surface_.coefficientCount(); ++node)
    if (surface_.isOnBorder(node)) onBorder.push_back(node);
  writeList(sink, onBorder);
}

Discretisation::Weights QuadraticDiscretisation::displacementWeights(
    std::span<const SurfacePoint> places) const {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const ElementPlace place = QuadraticSurface::place(places[k].triangle, places[k].weights);
    const QuadraticBasis basis(place.u, place.v);
    for (int f = 0; f < 6; ++f)
      entries.emplace_back(static_cast<int>(k), surface_.coefficients(place.element)[f],
                           basis.values[f]);
  }
  Weights weights(static_cast<Index>(places.size()), displacementCount());
  weights.setFromTriplets(entries.begin(), entries.end());
  return weights;
}

Resultant QuadraticDiscretisation::resultant(const VectorXd& p,
                                             std::span<const int> elements) const {
  return integrals().resultant(p, elements);
}

double QuadraticDiscretisation::strainEnergy(const VectorXd& u, const VectorXd& p) const {
  return integrals().strainEnergy(u, p);
}

std::vector<Matrix3d> QuadraticDiscretisation::surfaceStress(const VectorXd& u, const VectorXd& p,
                                                             const Material& material) const {
  std::vector<Matrix3d> stress(slots_.slots.size(), Matrix3d::Zero());
  std::vector<double> weight(slots_.slots.size(), 0);
  for (int e = 0; e < surface_.elementCount(); ++e) {
    const Eigen::Matrix3Xd displacements = gather(u, surface_.coefficients(e));
    for (int f = 0; f < 6; ++f) {
      const int slot = surface_.slots(e)[f];
      const ElementPlace node = surface_.placeOf(surface_.coefficients(e)[f], e);
      // Stress is unbounded on the border of a support: as for the coefficients of traction, the
      // value at the next node stands for it.
      const Eigen::Vector2d local =
          surface_.coordinates(e).awayFromBorder({node.u, node.v}, kBorderTractionRoot);
      const ElementPlace place{e, local[0], local[1]};
      const SurfaceTangents at = surface_.tangents(place);
      const double area = surface_.evaluate(place).areaVector().norm();
      stress[slot] +=
          area * bem::surfaceStress(at.frame, displacements * at.slopes.transpose(),
                                    p.segment<3>(3 * static_cast<Index>(slot)), material);
      weight[slot] += area;
    }
  }
  for (std::size_t s = 0; s < stress.size(); ++s) stress[s] /= weight[s];
  return stress;
}

Vector3d QuadraticDiscretisation::position(const SurfacePoint& at) const {
  return surface_.evaluate(QuadraticSurface::place(at.triangle, at.weights)).position;
}

Vector3d QuadraticDiscretisation::interpolate(const SurfacePoint& at, const VectorXd& u) const {
  const ElementPlace place = QuadraticSurface::place(at.triangle, at.weights);
  std::vector<double> basis;
  surface_.evaluateBasis(place, basis);
  return weightedSum(basis, surface_.coefficients(place.element), u);
}

Vector3d QuadraticDiscretisation::displacementAt(const SurfacePoint& place, const VectorXd& u,
                                                 const VectorXd& p, const Bulk& bulk) const {
  return interpolate(place, u) + displacementDefect(place, u, p, bulk);
}

Vector3d QuadraticDiscretisation::tractionAt(const SurfacePoint& at, const VectorXd& p) const {
  ElementPlace place = QuadraticSurface::place(at.triangle, at.weights);
  const Eigen::Vector2d local =
      surface_.coordinates(place.element).awayFromBorder({place.u, place.v}, kMinBorderRoot);
  place = {place.element, local[0], local[1]};
  std::vector<double> basis;
  surface_.evaluateTractionBasis(place, basis);
  return weightedSum(basis, surface_.slots(place.element), p);
}

Vector3d QuadraticDiscretisation::displacementDefect(const SurfacePoint& place, const VectorXd& u,
                                                     const VectorXd& p, const Bulk& bulk) const {
  // At the border of a support the metric is singular and the displacement known: towards it the
  // defect decreases like the root of the distance.
  const ElementPlace at = QuadraticSurface::place(place.triangle, place.weights);
  const BorderCoordinates& coordinates = surface_.coordinates(at.element);
  const Eigen::Vector2d local(at.u, at.v);
  const double root = coordinates.root(local);
  if (root >= kMinBorderRoot)
    return results().displacementDefect(surface_.placesAt(at), u, p, bulk);
  if (root == 0) return Vector3d::Zero();
  const Eigen::Vector2d away = coordinates.awayFromBorder(local, kMinBorderRoot);
  return root / kMinBorderRoot *
         results().displacementDefect(surface_.placesAt({at.element, away[0], away[1]}), u, p,
                                      bulk);
}

BoundaryField QuadraticDiscretisation::estimatedError(const ReferenceProblem& problem,
                                                      const BoundaryField& field, const Bulk& bulk,
                                                      const Job& job) const {
  // The estimate averages the residual with a rougher rule than the equations, whose error is about
  // five times theirs: measured on thin parts (docs/exchange.md). Other equations have no average.
  constexpr double kOfAveraged = 0.2;
  // Rougher than other results: the residual is interpolated with about this error (residuals.h).
  constexpr double kTolerance = 1e-4;
  const std::vector<bool> isAveraged = averagedNodes(surface_, slots_, problem.dofs());
  const auto share = [&](int node) { return isAveraged[node] ? kOfAveraged : 1.0; };
  const QuadraticQuadrature rough(surface_, kTolerance);
  return bem::estimatedError(ElementResults(surface_, rough), problem, field, bulk, share, job);
}

std::optional<InteriorState> QuadraticDiscretisation::interiorState(const VectorXd& u,
                                                                    const VectorXd& p,
                                                                    const Bulk& bulk,
                                                                    const Vector3d& point) const {
  return results().interiorState(u, p, bulk, point);
}

std::unique_ptr<InteriorEvaluator> QuadraticDiscretisation::makeInteriorEvaluator(
    std::vector<Vector3d> points, const Bulk& bulk, const Job& job) const {
  return std::make_unique<ElementInterior>(
      surface_, interiorQuadrature_.get(surface_, ElementInterior::kTolerance), bulk,
      std::move(points), job);
}

VolumeMoments QuadraticDiscretisation::volumeMoments() const {
  VolumeMoments moments(mesh().nodes.front());
  for (int e = 0; e < surface_.elementCount(); ++e)
    surface_.visitPoints(e, 1, [&](const ElementPlace&, const SurfaceJet& jet, double weight) {
      moments.add(jet.position, weight * jet.areaVector().normalized());
    });
  return moments;
}

VectorXd QuadraticDiscretisation::bodyForceTerm(const DegreesOfFreedom& dofs, const Bulk& bulk,
                                                const Job& job) const {
  return results().bodyForceTerm(quadraticEquations(surface_, mesh(), slots_, dofs), bulk, job);
}

BodyForceWork QuadraticDiscretisation::bodyForceWork(const Bulk& bulk) const {
  BodyForceWork work;
  if (!bulk.hasBodyForce()) return work;
  const VolumeMoments moments = volumeMoments();
  const Vector3d centre = moments.centroid();
  work.ofDisplacement = VectorXd::Zero(3 * static_cast<Index>(surface_.coefficientCount()));
  work.ofTraction = VectorXd::Zero(3 * static_cast<Index>(surface_.slotCount()));
  work.constant = particularWork(moments, bulk);
  std::vector<double> basis, ofTraction;
  for (int e = 0; e < surface_.elementCount(); ++e)
    surface_.visitPoints(
        e, 1, [&](const ElementPlace& place, const SurfaceJet& jet, double weight) {
          surface_.evaluateBasis(place, basis);
          surface_.evaluateTractionBasis(place, ofTraction);
          const ParticularState state =
              particularState(jet.position - centre, jet.areaVector().normalized(), bulk);
          for (std::size_t f = 0; f < basis.size(); ++f) {
            work.ofDisplacement.segment<3>(3 * static_cast<Index>(surface_.coefficients(e)[f])) -=
                weight * basis[f] * state.traction;
            work.ofTraction.segment<3>(3 * static_cast<Index>(surface_.slots(e)[f])) +=
                weight * ofTraction[f] * state.displacement;
          }
        });
  return work;
}

std::unique_ptr<ContactSurface> QuadraticDiscretisation::makeContactSurface(
    const DegreesOfFreedom& dofs) const {
  return std::make_unique<QuadraticContactSurface>(*this, dofs);
}

}  // namespace palpa::bem
