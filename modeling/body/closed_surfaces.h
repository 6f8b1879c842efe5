#pragma once

#include <array>
#include <span>

#include "modeling/body/body.h"

namespace palpa::modeling {

/// Number of separate closed surfaces of a body: one, and one for each closed cavity. Cost linear
/// in the number of patches or triangles.
int closedSurfaceCount(const Body& body);
/// The same of triangles that form closed, manifold surfaces.
int closedSurfaceCount(std::span<const std::array<int, 3>> triangles);

}  // namespace palpa::modeling
