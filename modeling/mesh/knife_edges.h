#pragma once

#include <set>

#include "base/job.h"
#include "modeling/mesh/faced_triangles.h"

namespace palpa::modeling {

/// A surface without knife edges.
struct WithoutKnifeEdges {
  FacedTriangles surface;
  int edges = 0;  ///< cut off: chains of edges without sharp corners
};

/// Cuts off the parts of the body beside knife edges, where it is thinner than `thinnest` (mm, a
/// twentieth of the edge length of the mesh; 0 keeps them): elements that are much longer than the
/// body is thick there know only the mean displacement of both sides. A knife edge has an angle
/// within the body below 20 degrees. Each is cut off by a bar along it (CGAL, corefinement), so
/// that a narrow face takes its place. Edges of `keptFaces` stay, and all of them if the surface
/// would cut through itself or fall into parts. `surface`: closed, oriented, manifold; so is the
/// result. Deterministic. Cost: below a µs per triangle, and 20 ms per edge. Throws Cancelled.
WithoutKnifeEdges withoutKnifeEdges(FacedTriangles surface, double thinnest,
                                    const std::set<int>& keptFaces, const Job& job = {});

}  // namespace palpa::modeling
