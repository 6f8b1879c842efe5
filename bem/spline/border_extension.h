#pragma once

#include <vector>

#include "bem/spline/spline_surface.h"

namespace palpa::bem {

/// Gives elements beside the borders of supports their BorderFunctions, from the sides of all
/// elements (SplineSurface::side()). `levels`: of the borders, by index. Previous functions beside
/// borders are replaced. Cost: about 0.1 ms per function on both sides of a border.
void extendAtBorders(SplineSurface& surface, const std::vector<LevelFunction>& levels);

}  // namespace palpa::bem
