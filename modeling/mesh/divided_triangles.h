#pragma once

#include <cstddef>
#include <optional>

#include "modeling/mesh/faced_triangles.h"

namespace palpa::modeling {

/// The same surface with its triangles divided until no edge is longer than `length` (mm, > 0);
/// none if that takes more than `most` triangles. Neighbours still share their edges: `surface`
/// must be closed and manifold, and so is the result.
std::optional<FacedTriangles> dividedTriangles(FacedTriangles surface, double length,
                                               std::size_t most);

}  // namespace palpa::modeling
