#pragma once

#include "bem/problem/reference_problem.h"
#include "modeling/mesh/mesh.h"

namespace palpa::app {

/// Refuses a model that does not fit into memory: throws SolverError (kTooLarge) with the numbers,
/// and what would fit. `coefficients`: of displacement, nodes with triangles; `limit`: bytes, 0 for
/// 85 % of what is available now.
void checkMemory(const modeling::MeshSettings& settings, bool hasSplines, double coefficients,
                 double slots, bem::Precision precision, double limit);

}  // namespace palpa::app
