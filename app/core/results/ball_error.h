#pragma once

#include "app/core/model/touch_model.h"

namespace palpa::app {

/// What the estimate needs to know of a ball that presses the body.
struct PressingBall {
  Eigen::Vector3d at, normal;  ///< place (mm) and outward normal on the unloaded surface
  double radius;               ///< mm, of the ball
  double maskRadius;           ///< mm, of the widest mask under pressure
  double force, deflection;    ///< N and mm, sizes of the contact's
  std::size_t masks;           ///< under pressure
};

/// Relative error of the force and the field by the pressure of a ball, which consists of masks of
/// radius r: larger the wider they are than the area of contact (radius a by H. Hertz), up to equal
/// radii, and the larger the part of the deflection is that the contact itself yields, as c F / (E*
/// r) of a half-space. With splines three times as large for one mask that reaches a sharp edge,
/// where the pressure is uneven: one mask cannot follow it. Measured by bench/coverage
/// (docs/verification.md).
double ballPressureError(const BoundarySetup& setup, const PressingBall& ball);

/// The same for a contact of a state; 0 for other tools, and for balls without pressure.
double ballPressureError(const BoundarySetup& setup, const TouchState::Contact& contact);

}  // namespace palpa::app
