#pragma once

#include <span>

#include "modeling/mesh/region_border.h"
#include "modeling/solid/edge_curve.h"
#include "modeling/solid/surface_evaluator.h"

namespace palpa::modeling {

/// Moves a point of a patch within the surface onto the borders of regions, by Newton's method for
/// value(x(u, v)) = 0: each step is the shortest one on the surface that reaches the borders to
/// first order. A point on a side of its patch (u or v at an end of the range) stays on the side if
/// `staysOnSide`. `tolerance`: distance from the borders that counts as reached, mm. False if the
/// point leaves the patch or does not arrive; `at` is then meaningless.
bool slideOntoBorders(const SurfaceEvaluator& surface, bool staysOnSide,
                      std::span<const RegionBorder* const> borders, double tolerance,
                      SurfaceParameter& at);

}  // namespace palpa::modeling
