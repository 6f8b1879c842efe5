#pragma once

#include <Eigen/Dense>

#include "bem/spline/spline_surface.h"

namespace palpa::bem {

/// Displacement coefficients of a surface with torn functions as coefficients of its net alone: 3
/// per control point that the surface was made with, mm. Functions that were not torn keep their
/// coefficients; for each torn one the two sides are replaced by the one value that is nearest to
/// them, in the mean square over the surface (all torn ones together). The change is of the order
/// of the discretisation error, as both sides approximate the same continuous displacement.
Eigen::VectorXd gluedCoefficients(const SplineSurface& surface, const Eigen::VectorXd& u);

}  // namespace palpa::bem
