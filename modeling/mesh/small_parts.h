#pragma once

#include <functional>
#include <set>

#include "base/job.h"
#include "modeling/mesh/faced_triangles.h"

namespace palpa::modeling {

/// Wanted length at a place, both mm.
using LengthAt = std::function<double(const Eigen::Vector3d&)>;

/// A surface without thin pins and narrow holes.
struct WithoutSmallParts {
  FacedTriangles surface;
  int pins = 0;   ///< cut off
  int holes = 0;  ///< filled, blind and through
};

/// Cuts off pins and fills holes that are thinner than `smallest` at all their places. Both are
/// parts of the surface behind closed chains of sharp edges (kSharpEdgeDegrees), concave ones about
/// a pin, convex ones about a hole. Thin means: the hydraulic diameter 4 V / A of the part with
/// flat ends and half of the extent of its chains are below `smallest`, and the part is long in one
/// direction only, so that thin plates stay. The flat end gets the face around it, or the part's
/// own if that one is in `keptFaces`. Parts with a face of `keptFaces`, and those with more than 5
/// % of the volume, stay. The surface stays closed, oriented and manifold. `surface`: closed,
/// oriented, manifold. Deterministic. Throws Cancelled.
WithoutSmallParts withoutSmallParts(FacedTriangles surface, const LengthAt& smallest,
                                    const std::set<int>& keptFaces, const Job& job = {});

}  // namespace palpa::modeling
