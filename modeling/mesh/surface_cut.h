#pragma once

#include "modeling/mesh/region_border.h"
#include "modeling/mesh/tagged_surface.h"

namespace palpa::modeling {

/// Cuts all triangles that the border crosses, so that each triangle lies on one side, and sets bit
/// k of SurfaceTag::sides of the triangles inside. The set of surface points does not change.
/// Feature edges that run along the border within `snap` mm become part of it, so that no strip
/// thinner than `snap` remains between them. Triangles around strokes are first divided until their
/// edges are shorter than half of `edgeLength` (mm) and about half of strokeEdge().
void cutAtBorder(TaggedSurface& surface, const RegionBorder& border, int k, double snap,
                 double edgeLength);

}  // namespace palpa::modeling
