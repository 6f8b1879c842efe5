#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "base/job.h"

namespace palpa::modeling {

/// Two triangles with common points other than common vertices.
struct TriangleCrossing {
  int a = -1;
  int b = -1;              ///< a < b
  bool isThrough = false;  ///< an edge of one passes through the inside of the other, or they
                           ///< overlap beyond a common edge; false if they only touch
  Eigen::Vector3d at;      ///< a common point, up to rounding
};

/// All crossings, ordered, at most `most`. A tree of boxes finds candidates, a separating axis test
/// in floating point excludes clearly disjoint pairs, and exact arithmetic (CGAL) decides the rest:
/// rounding neither hides nor invents a pair. Neighbours are reported only if they overlap: folded
/// onto each other along a common edge, or crossing beyond a common vertex.
///
/// Positions must be finite. Cost: about 3 µs per triangle of a good mesh. Throws Cancelled.
std::vector<TriangleCrossing> triangleCrossings(const std::vector<Eigen::Vector3d>& positions,
                                                const std::vector<std::array<int, 3>>& triangles,
                                                std::size_t most = 10000, const Job& job = {});

}  // namespace palpa::modeling
