#pragma once

#include <Eigen/Dense>

#include "bem/spline/spline_surface.h"

namespace palpa::bem {

/// Displacement coefficients on the original control net, computed from the coefficients `u` of a
/// surface with torn functions: 3 per control point that the surface was constructed with, mm.
/// Functions that were not torn keep their coefficients. For each torn function the values of the
/// two sides are replaced by the single value nearest to them in the mean square over the surface
/// (all torn functions together). The change is of the order of the discretisation error, because
/// both sides approximate the same continuous displacement. Throws SolverError (kBadMesh) if a
/// patch has no area.
Eigen::VectorXd gluedCoefficients(const SplineSurface& surface, const Eigen::VectorXd& u);

}  // namespace palpa::bem
