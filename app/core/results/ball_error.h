#pragma once

#include "app/core/model/touch_model.h"

namespace palpa::app {

/// Relative error of the force and the field by the pressure of a ball, which consists of masks of
/// radius r: larger the wider they are than the area of contact (radius a by H. Hertz), up to equal
/// radii, and the larger the part of the deflection is that the contact itself yields, as c F / (E*
/// r) of a half-space. Measured by bench/coverage (docs/verification.md). 0 for other tools.
double ballPressureError(const BoundarySetup& setup, const TouchState::Contact& contact);

}  // namespace palpa::app
