#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

namespace palpa::modeling {

/// Triangles of a polygon (indices into `points`), in the orientation of the polygon. Ears are cut
/// in the projection along the mean normal, the best shaped ear first. Corners need not lie exactly
/// in a plane; a self-crossing polygon gives overlapping triangles. O(n²) for n corners.
std::vector<std::array<int, 3>> triangulatePolygon(const std::vector<Eigen::Vector3d>& points,
                                                   std::span<const int> polygon);

}  // namespace palpa::modeling
