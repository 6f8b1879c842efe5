#pragma once

#include "modeling/body/region.h"
#include "modeling/mesh/tagged_surface.h"

namespace palpa::modeling {

/// Cuts all triangles that the border of the half space crosses, so that each lies on one side, and
/// sets bit k of the tags of those inside. The surface stays the same set of points. Feature edges
/// that run along the border within `snap` mm become part of it, so that no strip thinner than that
/// is left between the two.
void cutAtBorder(TaggedSurface& surface, const HalfSpace& half, int k, double snap);

}  // namespace palpa::modeling
