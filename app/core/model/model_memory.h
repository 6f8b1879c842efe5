#pragma once

#include "bem/problem/problem_inputs.h"
#include "modeling/mesh/mesh_settings.h"

namespace palpa::app {

/// Throws SolverError (kTooLarge) if a model does not fit into memory; the message names the sizes
/// and a remedy. `coefficients`: number of displacement coefficients, with triangles of nodes;
/// `slots`: number of traction slots; `limit`: bytes, 0 for 85 % of the memory available now.
void checkMemory(const modeling::MeshSettings& settings, bool hasSplines, double coefficients,
                 double slots, bem::Precision precision, double limit);

}  // namespace palpa::app
