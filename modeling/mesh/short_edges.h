#pragma once

#include <set>
#include <vector>

#include "base/job.h"
#include "modeling/mesh/small_parts.h"

namespace palpa::modeling {

/// Joins the ends of edges shorter than the smaller of the lengths at its ends (mm, one per vertex;
/// 0 keeps all edges there), so that the volume stays (Lindstrom and Turk, "Fast and memory
/// efficient polygonal simplification", 1998; CGAL), and the two borders of narrower strips between
/// sharp edges. The borders of `keptFaces` stay. Deterministic; the result may cut through itself.
/// Throws Cancelled.
FacedTriangles withoutShortEdges(const FacedTriangles& body, const std::vector<double>& lengths,
                                 const std::set<int>& keptFaces, const Job& job);

}  // namespace palpa::modeling
