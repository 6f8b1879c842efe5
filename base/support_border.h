#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace palpa {

/// Vertices of a triangle mesh on the border of supports or on notches, around which six-node
/// triangles take the square root of the distance from the border as their coordinate
/// (bem/quadratic/border_coordinates.h): those between a supported and a free triangle, and the
/// ends of notches. Two of them in one triangle are joined by an edge of the border; where the mesh
/// has it otherwise, one of them is left out.
///
/// `isSupported`: per triangle; `vertexCount`: number of vertices; `isNotch`: see notchEdges().
/// Returns one value per vertex.
std::vector<bool> supportBorderVertices(const std::vector<std::array<int, 3>>& triangles,
                                        const std::vector<bool>& isSupported, int vertexCount,
                                        const std::vector<std::array<bool, 3>>& isNotch);

/// Notches, at which the stress is unbounded: edges between free triangles of two smoothing groups
/// where the angle within the material is at least 30° above 180°. Per triangle and edge from
/// corner k to the next; `positions`: mm.
std::vector<std::array<bool, 3>> notchEdges(const std::vector<std::array<int, 3>>& triangles,
                                            const std::vector<Eigen::Vector3d>& positions,
                                            const std::vector<int>& smoothingGroups,
                                            const std::vector<bool>& isSupported);

/// Edges between a supported and a free triangle, per triangle and edge from corner k to the next.
std::vector<std::array<bool, 3>> supportBorderEdges(
    const std::vector<std::array<int, 3>>& triangles, const std::vector<bool>& isSupported);

/// Place of the middle node of an edge with such a vertex at exactly one end: fraction of the edge
/// from that vertex, where the square root of the distance is half of its value at the other end.
inline constexpr double kBorderEdgeShare = 0.25;

}  // namespace palpa
