#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "base/job.h"

namespace palpa::modeling {

/// Two triangles that share more than the vertices they have in common.
struct TriangleCrossing {
  int a = -1;
  int b = -1;              ///< a < b
  bool isThrough = false;  ///< an edge of one passes through the inside of the other, or they
                           ///< overlap beyond a common edge; false when they only touch
  Eigen::Vector3d at;      ///< a point of both, up to rounding
};

/// All such pairs, ordered, by a tree of boxes, a separating axis test in floating point for what
/// is clearly apart, and exact arithmetic (CGAL) for the rest: no pair is missed or made up by
/// rounding. Neighbours are reported only when they overlap: folded onto each other along a common
/// edge, or cutting each other beyond a common vertex. Stops after `most` pairs.
///
/// Positions must be finite. Cost: about 3 µs per triangle of a good mesh. @throws Cancelled
std::vector<TriangleCrossing> triangleCrossings(const std::vector<Eigen::Vector3d>& positions,
                                                const std::vector<std::array<int, 3>>& triangles,
                                                std::size_t most = 10000, const Job& job = {});

}  // namespace palpa::modeling
