#include "app/core/results/error_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include "app/core/results/ball_error.h"
#include "app/core/results/touch.h"
#include "base/box_tree.h"
#include "base/parallel.h"
#include "bem/base/error.h"
#include "bem/model/surface_point.h"
#include "bem/problem/interior_evaluator.h"
#include "bem/spline/spline_discretisation.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;

constexpr int kPresses = 6;
/// Places at which the error is weighted with the energy.
constexpr int kPlacesOfEnergy = 48;
/// Depth of a press over the fingertip's radius; the result does not depend on it, as the body is
/// linear.
constexpr double kDepth = 0.1;
/// Displacements below this part of the body's size count as zero.
constexpr double kStill = 1e-9;

/// True if the border of a support runs through patches of splines, whose elements then do not
/// follow the field there.
bool hasCutSplines(const BoundarySetup& setup) {
  if (!setup.splines) return false;
  const bem::SplineSurface& surface = setup.splines->surface();
  for (int e = 0; e < surface.elementCount(); ++e)
    if (surface.isCut(e)) return true;
  return false;
}

/// Factors from the estimates to errors that cover the true ones of 95 % of random bodies, for the
/// field and at contacts: the residual sees only a part where flat triangles change the body, or
/// splines are cut; at contacts splines have less of it than elsewhere. Measured by bench/coverage
/// (docs/verification.md) and with finer models of the examples (tests/app).
struct CoverFactors {
  double field, contact;
};
CoverFactors coverFactors(const BoundarySetup& setup) {
  if (setup.engine == modeling::Engine::kTriangles) return {5, 5};
  if (setup.engine == modeling::Engine::kQuadratic) return {4.25, 1.85};
  return {hasCutSplines(setup) ? 2.8 : 1.5, 3.8};
}

/// A further factor where forces are given: a stiffness that is wrong as a whole moves all places,
/// while a given displacement keeps the field at its place. Measured as coverFactors().
double factorOfGivenForces(const BoundarySetup& setup, const TouchState& state) {
  const bool areGiven = !setup.loads.empty() || setup.bulk().hasBodyForce() ||
                        std::any_of(state.contacts.begin(), state.contacts.end(),
                                    [](const auto& contact) { return contact.hasGivenForce(); });
  if (!areGiven) return 1;
  return setup.engine == modeling::Engine::kQuadratic ? 1.5 : 2;
}

/// The error of one of several fields: the part that the functions can represent, dominated by the
/// soft modes of slender bodies, and the part that varies within elements.
class EstimatedError {
 public:
  /// `bulk`: with the body force that the fields contain; `carried`:
  /// bem::Discretisation::estimatedError() of `fields`.
  EstimatedError(const BoundarySetup& setup, const bem::Bulk& bulk,
                 const bem::BoundaryField& fields, const bem::BoundaryField& carried,
                 Eigen::Index column)
      : setup_(setup),
        bulk_(bulk),
        u_(fields.u.col(column)),
        p_(fields.p.col(column)),
        carried_(carried.u.col(column)) {}

  /// Squares of the error and of the displacement, mm^2, at a place or summed over places.
  struct Squares {
    double error = 0, moved = 0, weights = 0;
    void add(const Squares& other, double weight = 1) {
      error += weight * other.error;
      moved += weight * other.moved;
      weights += weight;
    }
    /// Over the displacement of the places, or a larger one, mm.
    double relative(double displacement = 0) const {
      const double over = std::max(moved, weights * displacement * displacement);
      return over > 0 ? std::sqrt(error / over) : 0;
    }
  };
  Squares at(const bem::SurfacePoint& place) const {
    const bem::Discretisation& on = *setup_.discretisation;
    return {(on.interpolate(place, carried_) + on.displacementDefect(place, u_, p_, bulk_))
                .squaredNorm(),
            on.interpolate(place, u_).squaredNorm()};
  }

 private:
  const BoundarySetup& setup_;
  const bem::Bulk bulk_;
  const Eigen::VectorXd u_, p_, carried_;
};

/// Strain energy per volume on the surface.
class EnergyDensity {
 public:
  EnergyDensity(const BoundarySetup& setup, const bem::BoundaryField& field)
      : setup_(setup),
        stress_(
            setup.discretisation->surfaceStress(field.u.col(0), field.p.col(0), setup.material)) {}

  /// N/mm^2, at the middle of the place's triangle.
  double at(const bem::SurfacePoint& place) const {
    Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
    for (const int slot : setup_.meshSlots().ofCorner[static_cast<std::size_t>(place.triangle)])
      stress += stress_[static_cast<std::size_t>(slot)] / 3;
    return 0.5 * stress.cwiseProduct(bem::strainOf(stress, setup_.material)).sum();
  }

 private:
  const BoundarySetup& setup_;
  std::vector<Eigen::Matrix3d> stress_;
};

/// Error and displacement at places, on the threads of the job.
std::vector<EstimatedError::Squares> errorsAt(const std::vector<bem::SurfacePoint>& places,
                                              const EstimatedError& error, const Job& job) {
  std::vector<EstimatedError::Squares> errors(places.size());
  parallelFor(static_cast<std::ptrdiff_t>(places.size()), job, [&](std::ptrdiff_t k) {
    errors[static_cast<std::size_t>(k)] = error.at(places[static_cast<std::size_t>(k)]);
  });
  return errors;
}

bem::BoundaryField carriedError(const TouchModel& model, const bem::Bulk& bulk,
                                const bem::BoundaryField& fields, const Job& job) {
  return model.setup().discretisation->estimatedError(*model.problem(), fields, bulk, job);
}

/// Relative error at the middle of a contact and four places half-way to its border, over the
/// displacement of the contact; 0 for a contact that does not move.
double errorAtContact(const bem::BoundaryMesh& mesh, const EstimatedError& error,
                      const TouchState::Contact& contact) {
  EstimatedError::Squares sum;
  const double reach = contact.isBall() ? contact.patchRadius() : contact.radius;
  const Vector3d along = contact.normal.unitOrthogonal(), across = contact.normal.cross(along);
  for (const Vector3d& direction :
       std::array<Vector3d, 5>{Vector3d::Zero(), along, -along, across, -across})
    sum.add(error.at(bem::nearestSurfacePoint(mesh, contact.at + 0.5 * reach * direction)));
  const double moved = contact.displacement.norm();
  return moved > kStill * mesh.boundingSize() ? std::sqrt(sum.error / 5) / moved : 0;
}

/// Middles of at least `samples` evenly spread triangles of a list, if it has so many: triangles
/// with close numbers are close in space.
std::vector<bem::SurfacePoint> spread(const bem::BoundaryMesh& mesh,
                                      const std::vector<int>& triangles, int samples) {
  const Vector3d middle = Vector3d::Constant(1.0 / 3);
  const std::size_t step = std::max<std::size_t>(1, triangles.size() / std::max(samples, 1));
  std::vector<bem::SurfacePoint> places;
  for (std::size_t k = step / 2; k < triangles.size(); k += step)
    places.push_back({triangles[k], middle, mesh.point(triangles[k], middle), 0.0});
  return places;
}

/// Triangles at a distance of more than `radius` from all supports; without such triangles, those
/// outside supports.
std::vector<int> awayFromSupports(const BoundarySetup& setup, double radius) {
  const bem::BoundaryMesh& mesh = setup.mesh();
  const auto middleOf = [&mesh](int triangle) {
    return mesh.point(triangle, Vector3d::Constant(1.0 / 3));
  };
  std::vector<bool> isSupported(static_cast<std::size_t>(mesh.triangleCount()), false);
  std::vector<Vector3d> supported;
  std::vector<BoxTree::Box> boxes;
  for (const BoundarySetup::Part& support : setup.supports)
    for (const int triangle : support.triangles) {
      isSupported[static_cast<std::size_t>(triangle)] = true;
      supported.push_back(middleOf(triangle));
      boxes.emplace_back(supported.back());
    }
  const BoxTree tree(boxes, supported);
  const auto isNear = [&](const Vector3d& place) {
    bool found = false;
    tree.visitNear(place, radius, [&](int each, double reach) {
      found = found ||
              (supported[static_cast<std::size_t>(each)] - place).squaredNorm() < radius * radius;
      return found ? 0.0 : reach;
    });
    return found;
  };
  std::vector<int> away, outside;
  for (int t = 0; t < mesh.triangleCount(); ++t) {
    if (isSupported[static_cast<std::size_t>(t)]) continue;
    outside.push_back(t);
    if (!isNear(middleOf(t))) away.push_back(t);
  }
  return away.empty() ? outside : away;
}

}  // namespace

bool isNearSupport(const BoundarySetup& setup, const Vector3d& place, double radius) {
  const bem::BoundaryMesh& mesh = setup.mesh();
  const auto isNear = [&](int triangle) {
    const auto& corners = mesh.triangles[static_cast<std::size_t>(triangle)];
    return std::any_of(corners.begin(), corners.end(), [&](int node) {
      return (mesh.nodes[static_cast<std::size_t>(node)] - place).squaredNorm() < radius * radius;
    });
  };
  return std::any_of(setup.supports.begin(), setup.supports.end(), [&](const auto& support) {
    return std::any_of(support.triangles.begin(), support.triangles.end(), isNear);
  });
}

double StateError::largest() const {
  double error = field;
  for (const double contact : contacts) error = std::max(error, contact);
  return error;
}

double StateError::ofForces() const {
  return contacts.empty() ? field : *std::max_element(contacts.begin(), contacts.end());
}

double estimateError(const TouchModel& model, const TouchState& state, const Job& job) {
  return estimateErrors(model, state, job).largest();
}

void addErrors(const TouchModel& model, TouchState& state, const Job& job) {
  const StateError errors = estimateErrors(model, state, job);
  state.errorEstimate = errors.largest();
  state.forceErrorEstimate = errors.ofForces();
  for (std::size_t k = 0; k < state.contacts.size(); ++k)
    state.contacts[k].errorEstimate = errors.contacts[k];
}

StateError estimateErrors(const TouchModel& model, const TouchState& state, const Job& job,
                          int samples) {
  Job quiet = job;
  quiet.progress = nullptr;
  const bem::BoundaryMesh& mesh = model.setup().mesh();
  const bem::Bulk bulk = model.setup().bulk();
  const EstimatedError error(model.setup(), bulk, state.field,
                             carriedError(model, bulk, state.field, quiet), 0);
  std::vector<int> all(static_cast<std::size_t>(mesh.triangleCount()));
  std::iota(all.begin(), all.end(), 0);
  // By area: triangles are small beside supports and contacts, where the displacement is
  // prescribed.
  const std::vector<bem::SurfacePoint> places = spread(mesh, all, samples);
  const std::vector<EstimatedError::Squares> errors = errorsAt(places, error, quiet);
  EstimatedError::Squares sum;
  for (std::size_t k = 0; k < places.size(); ++k) sum.add(errors[k], mesh.area(places[k].triangle));
  // Also weighted by the energy: the error of parts that are only carried along, like the pins of a
  // chip that is pressed elsewhere, costs no energy and does not change a force. Not by area: near
  // a contact, where most of the energy is, are most triangles.
  EstimatedError::Squares strained;
  if (!state.contacts.empty()) {
    const EnergyDensity energy(model.setup(), state.field);
    const std::vector<bem::SurfacePoint> some = spread(mesh, all, kPlacesOfEnergy);
    const std::vector<EstimatedError::Squares> ofSome = errorsAt(some, error, quiet);
    for (std::size_t k = 0; k < some.size(); ++k) strained.add(ofSome[k], energy.at(some[k]));
  }
  StateError estimate;
  const CoverFactors factors = coverFactors(model.setup());
  const double ofForces = factorOfGivenForces(model.setup(), state);
  estimate.field = ofForces * factors.field * std::max(sum.relative(), state.relativeBalance);
  double fromArea = 0;
  for (const TouchState::Contact& contact : state.contacts) {
    // The residual at a contact does not show what is wrong with the body as a whole: a force has
    // at least the error of the field where the body is strained.
    const double ofContact =
        ofForces * factors.contact *
        std::max({errorAtContact(mesh, error, contact),
                  strained.relative(contact.displacement.norm()), state.relativeBalance});
    const double ofArea = ballPressureError(model.setup(), contact);
    fromArea = std::max(fromArea, ofArea);
    estimate.contacts.push_back(ofContact + ofArea);
  }
  // A wrong force moves the whole body wrongly.
  estimate.field += fromArea;
  return estimate;
}

std::vector<PressError> estimatePressErrors(const TouchModel& model,
                                            std::span<const Vector3d> places, double radius,
                                            const Job& job) {
  const BoundarySetup& setup = model.setup();
  Job quiet = job;
  quiet.progress = nullptr;
  std::vector<TouchState> presses;
  std::vector<PressError> errors(places.size());
  std::vector<std::size_t> pressed;
  for (std::size_t k = 0; k < places.size(); ++k) {
    job.throwIfCancelled();
    modeling::Touch press;
    press.name = "press";
    press.at = places[k];
    press.radius = radius;
    press.vector = -kDepth * radius *
                   setup.mesh().normal(bem::nearestSurfacePoint(setup.mesh(), places[k]).triangle);
    try {
      presses.push_back(playTouches(model, std::span(&press, 1), 0, quiet));
      pressed.push_back(k);
    } catch (const bem::SolverError&) {
      // No place is free.
    }
  }
  // All at once: the residual of several fields costs little more than the residual of one.
  const auto count = static_cast<Eigen::Index>(presses.size());
  const bem::BoundaryField& rest = model.rest().field;
  bem::BoundaryField fields{Eigen::MatrixXd(rest.u.rows(), count),
                            Eigen::MatrixXd(rest.p.rows(), count)};
  for (Eigen::Index k = 0; k < count; ++k) {
    // The effect of the press without the loads and the weight.
    fields.u.col(k) = presses[static_cast<std::size_t>(k)].field.u - rest.u;
    fields.p.col(k) = presses[static_cast<std::size_t>(k)].field.p - rest.p;
  }
  if (count == 0) return errors;
  const double factor = coverFactors(setup).contact;
  const bem::Bulk bulk(setup.material);
  const bem::BoundaryField carried = carriedError(model, bulk, fields, quiet);
  for (Eigen::Index k = 0; k < count; ++k) {
    job.throwIfCancelled();
    const TouchState::Contact& press = presses[static_cast<std::size_t>(k)].contacts.front();
    PressError& error = errors[pressed[static_cast<std::size_t>(k)]];
    error.relative =
        factor *
        errorAtContact(setup.mesh(), EstimatedError(setup, bulk, fields, carried, k), press);
    error.radius = press.radius;
  }
  return errors;
}

TouchError estimateTouchError(const TouchModel& model, const Job& job) {
  const BoundarySetup& setup = model.setup();
  const double radius = defaultTouchRadius(setup.mesh());
  std::vector<Vector3d> places;
  for (const bem::SurfacePoint& place :
       spread(setup.mesh(), awayFromSupports(setup, radius), kPresses))
    places.push_back(place.position);
  TouchError error;
  for (const PressError& press : estimatePressErrors(model, places, radius, job)) {
    error.relative = std::max(error.relative, press.relative);
    error.widening = std::max(error.widening, press.radius / radius);
  }
  return error;
}

}  // namespace palpa::app
