#pragma once

#include "bem/element/polar_rule.h"
#include "bem/spline/spline_placement.h"

namespace palpa::bem {

/// Adds points for integrands like 1/r around a place inside or on the border of a cell, in polar
/// coordinates in the surface metric at the place. The metric must be regular there and should not
/// vary much over the cell; the cell should not be elongated.
void addPolar(const SplineSurface& surface, const SplineCell& cell, const ElementPlace& place,
              const SingularAccuracy& accuracy, ElementRule& rule);

/// True if a place is a corner of the cell in which both derivatives are nearly parallel.
bool isFoldedCorner(const SplineSurface& surface, const SplineCell& cell,
                    const ElementPlace& place);
/// Adds points for integrands like 1/r around such a corner.
void addFoldedCorner(const SplineSurface& surface, const SplineCell& cell,
                     const ElementPlace& place, const SingularAccuracy& accuracy,
                     ElementRule& rule);

}  // namespace palpa::bem
