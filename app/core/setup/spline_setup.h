#pragma once

#include "app/core/setup/boundary_setup.h"

namespace palpa::app {

/// makeBoundarySetup() of a project whose body is a solid, with splines.
///
/// Supports hold coefficients. A fixed one gives its displacement to all whose functions lie in it
/// (exactly, wherever its border runs: functions are torn there); one that barely reaches into it
/// stays free. A roller holds the component along the surface's normal at the function's Greville
/// point: exact on flat faces; on curved ones it slips between these by about 0.5 % of the sliding
/// with elements that turn by 22 degrees. Loads are L2-projected.
///
/// Throws SolverError (kBadCondition) as makeBoundarySetup(), ModelingError as refined().
BoundarySetup makeSplineSetup(const modeling::Project& project, const modeling::SurfaceMesh& mesh,
                              const SplineRefinement& net);

}  // namespace palpa::app
