#pragma once

#include <Eigen/Dense>
#include <span>
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

/// Estimates the errors of a state from `samples` places all over the surface, five at each contact
/// and, if there are contacts, 48 that are weighted by the strain energy (docs/theory.md). 0 where
/// nothing moves. Costs about as much as the assembly. Throws Cancelled.
StateError estimateErrors(const TouchModel& model, const TouchState& state, const Job& job = {},
                          int samples = 192);

/// Sets the estimates of a state and of its contacts.
void addErrors(const TouchModel& model, TouchState& state, const Job& job = {});

/// The largest of the errors.
double estimateError(const TouchModel& model, const TouchState& state, const Job& job = {});

/// True if a support is nearer to a place than `radius` (mm): forces of contacts there are less
/// accurate than estimateTouchError().
bool isNearSupport(const BoundarySetup& setup, const Eigen::Vector3d& place, double radius);

/// Estimated error of the force under a rigid mask that presses the body; 0 where supports hold the
/// whole place.
struct PressError {
  double relative = 0;
  double radius = 0;  ///< of the mask, mm: larger than wanted where the mesh cannot represent it
};

/// Errors of presses with masks of `radius` (mm), one at a time, at places on the surface. Do not
/// depend on loads. Costs a few times as much as the assembly, and a solution per place. Throws
/// Cancelled.
std::vector<PressError> estimatePressErrors(const TouchModel& model,
                                            std::span<const Eigen::Vector3d> places, double radius,
                                            const Job& job);

/// Estimated error of touches anywhere on a model.
struct TouchError {
  double relative = 0;  ///< of the force under a fingertip; 0 if supports cover the whole surface
  /// Of the masks under these fingertips, over the radius of a fingertip; above 1 where the mesh
  /// cannot represent a fingertip.
  double widening = 1;
};

/// Error of the force under a fingertip that presses the body: the maximum over a few presses
/// spread over the free surface, at least the radius of the fingertip away from supports (closer
/// ones have larger errors, which concern few places). Does not depend on loads. Costs a few times
/// as much as the assembly. Throws Cancelled.
TouchError estimateTouchError(const TouchModel& model, const Job& job);

}  // namespace palpa::app
