#pragma once

#include "modeling/body/body.h"

namespace palpa::modeling {

/// Number of separate closed surfaces of a body: one, and one for each closed cavity. Cost linear
/// in the number of patches or triangles.
int closedSurfaceCount(const Body& body);

}  // namespace palpa::modeling
