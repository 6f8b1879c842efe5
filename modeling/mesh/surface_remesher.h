#pragma once

#include "base/job.h"
#include "modeling/mesh/size_field.h"
#include "modeling/mesh/small_features.h"
#include "modeling/mesh/tagged_surface.h"

namespace palpa::modeling {

/// New triangulation of a surface with the edge lengths of the size field, by isotropic remeshing
/// (Botsch and Kobbelt, "A remeshing approach to multiresolution modeling", 2004: split long edges,
/// collapse short edges, flip, relax, project back). Nodes stay on the given surface, nodes on
/// feature edges stay on these, and corners, where features meet or turn, do not move. Slivers
/// between features are relieved by locally shorter edges, but not shorter than `smallest` wants.
/// Deterministic.
/// Throws ModelingError if more than kMaxNodes nodes are needed; Cancelled.
TaggedSurface remesh(const TaggedSurface& surface, SizeField sizes, const LengthAt& smallest,
                     const Job& job);

}  // namespace palpa::modeling
