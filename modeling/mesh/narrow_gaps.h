#pragma once

#include <set>

#include "base/job.h"
#include "modeling/mesh/faced_triangles.h"

namespace palpa::modeling {

/// A surface without narrow gaps.
struct WithoutNarrowGaps {
  FacedTriangles surface;
  int gaps = 0;  ///< filled
};

/// Fills gaps between parts of the surface that face each other, where they are narrower than
/// `narrowest` (mm, a twentieth of the edge length of the mesh; 0 keeps gaps): the boundary
/// integral equations on both sides of a much narrower gap than the elements are nearly the same.
/// Each gap is filled with a plate that reaches slightly into the surface on both sides, except at
/// its mouth, and united with the body (CGAL, corefinement). `keptFaces` and their borders stay: at
/// gaps beside them the plate ends before, at most five times `narrowest`. All gaps stay if a
/// surface would cut through itself or get a cavity. `surface`: closed, oriented, manifold; so is
/// the result. Deterministic. Cost: some µs per triangle, and 20 ms per gap. Throws Cancelled.
WithoutNarrowGaps withoutNarrowGaps(FacedTriangles surface, double narrowest,
                                    const std::set<int>& keptFaces, const Job& job = {});

}  // namespace palpa::modeling
