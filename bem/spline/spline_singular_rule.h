#pragma once

#include "bem/spline/spline_points.h"

namespace palpa::bem {

struct SingularAccuracy {
  double error;  ///< relative, of the integrals over a cell
  int radial;    ///< points from the place to the border of the cell
};

/// Adds points for integrands like 1/r around a place in or on the border of a cell: polar
/// coordinates in the metric of the surface there, which must not vanish and should not vary much
/// over the cell. The cell should not be long.
void addPolar(const SplineSurface& surface, const SplineCell& cell, const SplinePlace& place,
              const SingularAccuracy& accuracy, SplineRule& rule);

/// Is a place a corner of the cell in which both derivatives are nearly parallel?
bool isFoldedCorner(const SplineSurface& surface, const SplineCell& cell, const SplinePlace& place);
/// Adds points for integrands like 1/r around such a corner.
void addFoldedCorner(const SplineSurface& surface, const SplineCell& cell, const SplinePlace& place,
                     const SingularAccuracy& accuracy, SplineRule& rule);

}  // namespace palpa::bem
