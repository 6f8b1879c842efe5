#pragma once

#include "base/job.h"
#include "modeling/mesh/size_field.h"
#include "modeling/mesh/tagged_surface.h"

namespace palpa::modeling {

/// Triangulates a surface anew with edges as long as the size field wants (isotropic remeshing
/// after Botsch and Kobbelt, "A remeshing approach to multiresolution modeling", 2004: split long
/// edges, collapse short ones, flip, relax, project back). Nodes stay on the given surface; those
/// on feature edges stay on them; corners, where features meet or turn, stay where they are.
/// Deterministic. Slivers between features are relieved by locally shorter edges.
/// @throws Cancelled; ModelingError when more than kMaxNodes nodes would be made
TaggedSurface remesh(const TaggedSurface& surface, SizeField sizes, const Job& job);

}  // namespace palpa::modeling
