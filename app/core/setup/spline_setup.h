#pragma once

#include "app/core/setup/boundary_setup.h"

namespace palpa::app {

/// makeBoundarySetup() for a geometry that uses splines.
///
/// Supports fix coefficients. A fixed support gives its displacement to all coefficients whose
/// functions lie in it (exactly, wherever its border runs: patches are cut there); a coefficient
/// whose function barely reaches into it stays free. A roller fixes the component along the
/// surface's normal at the function's Greville point: exact on flat faces; on curved faces the
/// surface slips between these points by about 0.5 % of the sliding with elements that turn by 22
/// degrees. Loads are L2-projected.
///
/// Throws SolverError (kBadCondition) as makeBoundarySetup(), ModelingError as refined().
BoundarySetup makeSplineSetup(const ProjectGeometry& geometry, const modeling::SurfaceMesh& mesh);

}  // namespace palpa::app
