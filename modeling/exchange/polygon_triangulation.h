#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

namespace palpa::modeling {

/// Cuts a polygon into triangles of the same sense, seen along its mean normal: the best shaped ear
/// first. Corners may be nearly in a plane only; a polygon that crosses itself gives triangles that
/// overlap. O(n²) for n corners.
std::vector<std::array<int, 3>> triangulatePolygon(const std::vector<Eigen::Vector3d>& points,
                                                   std::span<const int> polygon);

}  // namespace palpa::modeling
