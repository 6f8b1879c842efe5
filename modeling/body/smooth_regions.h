#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

namespace palpa::modeling {

/// An edge counts as sharp from this angle between the normals of its triangles (degrees): well
/// above what a reasonably fine tessellation of a curved surface shows, below what a designer calls
/// an edge.
inline constexpr double kSharpAngle = 40.0;

using Triangles = std::vector<std::array<int, 3>>;

/// For each triangle its neighbours over the edges 0–1, 1–2 and 2–0 of a closed, oriented, manifold
/// surface. O(n log n).
std::vector<std::array<int, 3>> triangleNeighbours(const Triangles& triangles);

/// For each triangle the one whose normal and membership it takes: itself, or, for a triangle too
/// thin for a reliable normal, its neighbour over the longest edge (followed until one is
/// reliable), so that slivers do not look like sharp edges.
std::vector<int> reliableTriangles(const std::vector<Eigen::Vector3d>& positions,
                                   const Triangles& triangles,
                                   std::span<const std::array<int, 3>> neighbours);

/// Divides a surface at its sharp edges: the number of its region for every triangle, regions
/// ordered by falling area. A region smaller than `leastArea` (mm²), or beyond the `most` largest,
/// is joined to the neighbour it has the longest border with. A sharp edge that ends inside a
/// region does not divide it.
std::vector<int> smoothRegions(const std::vector<Eigen::Vector3d>& positions,
                               const Triangles& triangles, double leastArea, int most);

}  // namespace palpa::modeling
