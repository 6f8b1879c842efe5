#pragma once

#include <set>

#include "base/job.h"
#include "modeling/body/mesh_body.h"
#include "modeling/mesh/small_parts.h"

namespace palpa::modeling {

/// Surface of a mesh body without its smallest features.
struct SimplifiedSurface : FacedTriangles {
  int vanishedFaces = 0;  ///< faces of the body without a triangle left
  int cutPins = 0;        ///< and knife edges, see withoutSmallParts(), withoutKnifeEdges()
  int filledHoles = 0;    ///< and gaps, see withoutNarrowGaps()
  double moved = 0;       ///< mm, the largest distance of both surfaces elsewhere, by samples
  bool isNeeded = false;  ///< false if all features are still there
};

/// Gaps that are filled, and knife edges that are cut off.
enum class ThinPlaces { kRemoved, kKept };

/// Removes features smaller than `smallest`: joins the ends of shorter edges so that the volume
/// stays (Lindstrom and Turk, "Fast and memory efficient polygonal simplification", 1998; CGAL) and
/// the two borders of narrower strips, after withoutSmallParts() with `thinnest`. Small fillets
/// become edges, small steps disappear. Gaps narrower than a fifth of `thinnest` anywhere are
/// filled, and knife edges cut off where they are thinner, if wanted. Curved surfaces keep at least
/// ten edges per circle, walls their thickness, and the borders of `keptFaces` stay. Where the
/// result would cut through itself, the features stay. Deterministic. Cost: about 30 µs per
/// triangle. Throws Cancelled.
SimplifiedSurface withoutSmallFeatures(const MeshBody& body, const LengthAt& smallest,
                                       const LengthAt& thinnest, const std::set<int>& keptFaces,
                                       ThinPlaces thin, const Job& job = {});

}  // namespace palpa::modeling
