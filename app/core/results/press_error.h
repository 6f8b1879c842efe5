#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "app/core/model/touch_model.h"

// Estimated errors of the forces under fingertips anywhere on a model, before it is touched.
namespace palpa::app {

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
