#pragma once

#include <cstddef>

#include "base/job.h"
#include "modeling/mesh/surface_mesh.h"

namespace palpa::modeling {

/// Number of crossings, at most `most`, between the quarters of the triangles of a mesh, as
/// quadraticMesh() makes them with straight edges: quarters of slivers may cross their neighbours,
/// because the middles of their edges are rounded. Cost: see triangleCrossings(). Throws Cancelled.
std::size_t quarterCrossings(const SurfaceMesh& mesh, std::size_t most, const Job& job = {});

}  // namespace palpa::modeling
