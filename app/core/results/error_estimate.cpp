#include "app/core/results/error_estimate.h"

#include <algorithm>
#include <numeric>

#include "app/core/results/ball_error.h"
#include "app/core/results/notch_error.h"
#include "app/core/results/sampled_error.h"
#include "app/core/results/shape_error.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;

/// Places around contacts, within so many of their radii, at which the error is sampled.
constexpr int kPlacesAroundContacts = 48;
constexpr double kAroundContact = 1.5;
/// Places at which the error is weighted with the energy.
constexpr int kPlacesOfEnergy = 48;

/// A further factor where forces are given: a stiffness that is wrong as a whole moves all places,
/// while a given displacement keeps the field at its place. Measured as coverFactors().
double factorOfGivenForces(const BoundarySetup& setup, const TouchState& state) {
  const bool areGiven = !setup.loads.empty() || setup.bulk().hasBodyForce() ||
                        std::any_of(state.contacts.begin(), state.contacts.end(),
                                    [](const auto& contact) { return contact.hasGivenForce(); });
  if (!areGiven) return 1;
  return setup.engine == modeling::Engine::kQuadratic ? 1.5 : 2;
}

/// Error of the field over the error of a ball's force by its pressure: the dip beside a ball is
/// more sensitive to its masks. Measured as coverFactors().
double factorOfDips(const BoundarySetup& setup) {
  return setup.splines ? 1 : 1.7;
}

bool isAroundContact(const TouchState& state, const Vector3d& place) {
  return std::any_of(state.contacts.begin(), state.contacts.end(), [&](const auto& contact) {
    return (place - contact.at).norm() < kAroundContact * reachOf(contact);
  });
}

/// Error and displacement integrated over triangles, by some places on them. By area: triangles are
/// small beside supports and contacts, where the displacement is prescribed.
SampledError::Squares squaresOver(const bem::BoundaryMesh& mesh, const std::vector<int>& triangles,
                                  int samples, const SampledError& error, const Job& job) {
  const std::vector<bem::SurfacePoint> places = spread(mesh, triangles, samples);
  const std::vector<SampledError::Squares> errors = errorsAt(places, error, job);
  double area = 0, sampled = 0;
  for (const int triangle : triangles) area += mesh.area(triangle);
  for (const bem::SurfacePoint& place : places) sampled += mesh.area(place.triangle);
  SampledError::Squares sum;
  for (std::size_t k = 0; k < places.size(); ++k)
    sum.add(errors[k], mesh.area(places[k].triangle) * area / sampled);
  return sum;
}

}  // namespace

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
  const SampledError error(model.setup(), bulk, state.field,
                           carriedError(model, bulk, state.field, quiet), 0);
  std::vector<int> all(static_cast<std::size_t>(mesh.triangleCount()));
  std::iota(all.begin(), all.end(), 0);
  // Around contacts places are denser: the dip of a ball may be the largest part of the field.
  std::vector<int> around, elsewhere;
  for (const int triangle : all) {
    const Vector3d middle = mesh.point(triangle, Vector3d::Constant(1.0 / 3));
    (isAroundContact(state, middle) ? around : elsewhere).push_back(triangle);
  }
  SampledError::Squares sum;
  sum.addSums(squaresOver(mesh, around, kPlacesAroundContacts, error, quiet));
  sum.addSums(squaresOver(mesh, elsewhere, samples, error, quiet));
  // Also weighted by the energy: the error of parts that are only carried along, like the pins of a
  // chip that is pressed elsewhere, costs no energy and does not change a force. Not by area: near
  // a contact, where most of the energy is, are most triangles.
  const EnergyDensity energy(model.setup(), state.field.u.col(0), state.field.p.col(0));
  SampledError::Squares strained;
  if (!state.contacts.empty()) {
    const std::vector<bem::SurfacePoint> some = spread(mesh, all, kPlacesOfEnergy);
    const std::vector<SampledError::Squares> ofSome = errorsAt(some, error, quiet);
    for (std::size_t k = 0; k < some.size(); ++k)
      strained.add(ofSome[k], energy.at(some[k].triangle));
  }
  StateError estimate;
  const CoverFactors factors = coverFactors(model.setup());
  const double ofForces = factorOfGivenForces(model.setup(), state);
  const double ofShape = shapeError(model, energy, state.energy, quiet) +
                         notchError(model.setup(), energy, state.energy);
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
    estimate.contacts.push_back(ofContact + ofArea + ofShape);
  }
  // A wrong force moves the whole body wrongly, and so does a wrong shape.
  estimate.field += ofShape + factorOfDips(model.setup()) * fromArea;
  return estimate;
}

}  // namespace palpa::app
