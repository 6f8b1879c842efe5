#pragma once

#include <optional>
#include <vector>

#include "bem/spline/spline_surface.h"
#include "bem/spline/spline_tractions.h"

namespace palpa::bem {

/// Collocation points, one per displacement coefficient: its Greville point. For a torn
/// coefficient, whose Greville point may lie on the other side of the border, the point lies in the
/// middle of the elements that use the coefficient. Beside a border with BorderFunctions, the point
/// is moved into the side to which the function belongs, at most 0.4 of the way to the Greville
/// point of the next function, so that no two points coincide. Throws std::invalid_argument if a
/// control point belongs to no patch.
std::vector<CollocationPlace> grevilleCollocation(const SplineSurface& surface);

/// Collocation point inside the part of the surface that contains a traction slot, at the fraction
/// `shift` (in (0, 1)) of the way from the Greville point of the slot's function to the Greville
/// point of the next function. It yields the equation for the additional traction of a coefficient
/// where faces with prescribed displacement meet at a sharp edge. None if the border of the part
/// lies between the two Greville points.
std::optional<CollocationPlace> shiftedCollocation(const SplineSurface& surface,
                                                   const SplineTractions& tractions, int slot,
                                                   double shift = 0.4);

}  // namespace palpa::bem
