#pragma once

#include <vector>

#include "app/core/model/touch_model.h"

// Error estimates from the residual of the boundary integral equation between the collocation
// points: from the correction of the unknowns (bem::Discretisation::estimatedError()) and from the
// local defect of displacements (displacementDefect()). Estimates, not bounds; tests compare them
// with exact and finer solutions.
namespace palpa::app {

/// Relative errors of a state.
struct StateError {
  /// Of displacements: root mean square over places all over the surface; at least the balance of
  /// forces, which shows errors in the bending of slender bodies that the residual does not.
  double field = 0;
  /// Of the force of each contact: root mean square of the error of displacements over places of
  /// the contact, as forces have the error of the displacements they cause; at least the balance.
  std::vector<double> contacts;

  double largest() const;
  /// Largest one of the contacts; of the field if there are none: then forces are reactions to
  /// loads.
  double ofForces() const;
};

/// Estimates the errors of a state from `samples` places all over the surface, 48 around
/// contacts, five at each contact and, if there are contacts, 48 that are weighted by the strain
/// energy (docs/theory.md). 0 where nothing moves. Costs about as much as the assembly. Throws
/// Cancelled.
StateError estimateErrors(const TouchModel& model, const TouchState& state, const Job& job = {},
                          int samples = 192);

/// Sets the estimates of a state and of its contacts.
void addErrors(const TouchModel& model, TouchState& state, const Job& job = {});

/// The largest of the errors.
double estimateError(const TouchModel& model, const TouchState& state, const Job& job = {});

}  // namespace palpa::app
