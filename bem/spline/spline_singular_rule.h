#pragma once

#include "bem/spline/spline_points.h"

namespace palpa::bem {

/// Accuracy of the rules for singular integrands.
struct SingularAccuracy {
  double error;  ///< relative, of the integrals over a cell
  int radial;    ///< number of points from the place to the border of the cell
};

/// Adds points for integrands like 1/r around a place inside or on the border of a cell, in polar
/// coordinates in the surface metric at the place. The metric must be regular there and should not
/// vary much over the cell; the cell should not be elongated.
void addPolar(const SplineSurface& surface, const SplineCell& cell, const SplinePlace& place,
              const SingularAccuracy& accuracy, SplineRule& rule);

/// True if a place is a corner of the cell in which both derivatives are nearly parallel.
bool isFoldedCorner(const SplineSurface& surface, const SplineCell& cell, const SplinePlace& place);
/// Adds points for integrands like 1/r around such a corner.
void addFoldedCorner(const SplineSurface& surface, const SplineCell& cell, const SplinePlace& place,
                     const SingularAccuracy& accuracy, SplineRule& rule);

}  // namespace palpa::bem
