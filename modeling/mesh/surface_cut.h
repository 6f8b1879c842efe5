#pragma once

#include "modeling/mesh/region_border.h"
#include "modeling/mesh/tagged_surface.h"

namespace palpa::modeling {

/// Cuts all triangles that the border crosses, so that each lies on one side, and
/// sets bit k of the tags of those inside. The surface stays the same set of points. Feature edges
/// that run along the border within `snap` mm become part of it, so that no strip thinner than that
/// is left between the two. Around strokes triangles are first divided until their edges are
/// shorter than half of `edgeLength` (mm) and about half of strokeEdge().
void cutAtBorder(TaggedSurface& surface, const RegionBorder& border, int k, double snap,
                 double edgeLength);

}  // namespace palpa::modeling
