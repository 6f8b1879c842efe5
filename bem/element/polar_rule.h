#pragma once

#include <array>
#include <span>

#include "bem/element/element_points.h"
#include "bem/element/element_surface.h"

namespace palpa::bem {

/// Accuracy of the rules for singular integrands.
struct SingularAccuracy {
  double error;  ///< relative, of the integrals over a cell
  int radial;    ///< number of points from the place to the border of the cell

  explicit SingularAccuracy(double tolerance);
};

/// Number of Gauss points on [first, last] for a function whose nearest poles lie at ± i pi/2.
int pointsForPoles(double first, double last, double error);

/// Adds points for integrands like 1/r around a place inside or on the border of a convex cell, in
/// polar coordinates in the surface metric at the place. `jet`: of the place, whose local
/// coordinates are `center`; `corners`: of the cell, counter-clockwise. The metric must be regular
/// at the place and should not vary much over the cell.
void addPolar(const SurfaceJet& jet, const Eigen::Vector2d& center,
              std::span<const Eigen::Vector2d> corners, const SingularAccuracy& accuracy,
              ElementRule& rule);

}  // namespace palpa::bem
