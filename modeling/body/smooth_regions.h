#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

namespace palpa::modeling {

/// Smallest angle between the normals of two triangles at which their common edge is
/// sharp: well above the angles in a reasonably fine tessellation of a curved surface, and below
/// the angles that a designer calls an edge.
inline constexpr double kSharpEdgeDegrees = 40.0;

using Triangles = std::vector<std::array<int, 3>>;

/// Neighbours of each triangle across its edges 0–1, 1–2 and 2–0 for a closed, oriented, manifold
/// surface. Cost O(n log n).
std::vector<std::array<int, 3>> triangleNeighbours(const Triangles& triangles);

/// Index of the triangle that determines the normal and the region of each triangle: itself, or,
/// for a triangle too thin for a reliable normal, its neighbour across the longest edge (repeated
/// until one is reliable), so that slivers do not look like sharp edges.
std::vector<int> reliableTriangles(const std::vector<Eigen::Vector3d>& positions,
                                   const Triangles& triangles,
                                   std::span<const std::array<int, 3>> neighbours);

/// Division of a surface at its sharp edges: the region number of every triangle, regions ordered
/// by decreasing area. A region smaller than `minArea` (mm²), or not among the `maxCount` largest,
/// is merged into the neighbour with the longest common border. A sharp edge that ends inside a
/// region does not divide it.
std::vector<int> smoothRegions(const std::vector<Eigen::Vector3d>& positions,
                               const Triangles& triangles, double minArea, int maxCount);

}  // namespace palpa::modeling
