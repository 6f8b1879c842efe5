#pragma once

#include "bench/peers/external_program.h"
#include "bench/peers/tetrahedra.h"

namespace palpa::bench {

/// Linear tetrahedra inside a surface by the program TetGen (H. Si, TetGen, a Delaunay-based
/// quality tetrahedral mesh generator, ACM TOMS 41, 2015), which keeps all nodes and triangles of
/// the surface and adds none to it. `run`: time and memory of the program. Throws
/// std::runtime_error if it is not installed or fails.
TetrahedralMesh meshWithTetgen(const bem::BoundaryMesh& surface, ProgramRun* run = nullptr);

}  // namespace palpa::bench
