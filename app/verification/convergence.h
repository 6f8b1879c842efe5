#pragma once

#include <vector>

#include "app/verification/check.h"
#include "base/job.h"

namespace palpa::verification {

inline constexpr const char* kConvergenceName = "convergence_sphere";

/// Solves for the field of a point force outside a sphere of R = 25 mm, 47 mm from its centre
/// (Kelvin's solution), on finer and finer meshes. The field is smooth and no polynomial, so no
/// engine represents it exactly. The exact displacement is prescribed on the lower sixth, exact
/// tractions elsewhere; nu = 0.3. Triangles: 98 to 1,946 nodes; cubic splines: 98 to 866 control
/// points. `isShort`: three steps, without the finest. Throws SolverError, Cancelled.
std::vector<ConvergenceStep> sphereConvergence(Engine engine, bool isShort, const Job& job);

/// Checks of a series: errors of some steps, and the order of the last refinement.
std::vector<Check> checksOf(const std::vector<ConvergenceStep>& steps, Engine engine);

}  // namespace palpa::verification
