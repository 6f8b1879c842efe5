#pragma once

#include <optional>
#include <vector>

#include "bem/spline/spline_surface.h"
#include "bem/spline/spline_tractions.h"

namespace palpa::bem {

/// Where the boundary integral equation is demanded to hold.
struct SplineCollocationPoint {
  Eigen::Vector3d position;         ///< mm
  std::vector<SplinePlace> places;  ///< in all elements that contain it
};

/// One point per displacement coefficient: its Greville point; of torn ones, whose Greville point
/// may lie on the other side, a point in the middle of their own.
std::vector<SplineCollocationPoint> grevilleCollocation(const SplineSurface& surface);

/// A point inside the part of the surface that a traction slot lies in, `shift` (in (0, 1)) of the
/// way from the Greville point of its function to that of the next: an equation for the further
/// traction of a coefficient where faces with prescribed displacement meet in a sharp edge. None
/// where the border of the part lies between.
std::optional<SplineCollocationPoint> shiftedCollocation(const SplineSurface& surface,
                                                         const SplineTractions& tractions, int slot,
                                                         double shift = 0.4);

}  // namespace palpa::bem
