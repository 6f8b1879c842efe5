#pragma once

#include <vector>

#include "base/job.h"
#include "bem/compressed/exact_rows.h"

namespace palpa::bem {

/// Division of all pairs of a cluster of points and a cluster of functions into distant ones, of
/// any level, and the rest, of leaves.
struct BlockDivision {
  std::vector<Ball> pointBalls, functionBalls;  ///< about points and elements of each cluster
  std::vector<std::vector<int>> far;   ///< distant clusters of functions, per cluster of points
  std::vector<std::vector<int>> near;  ///< ascending, per leaf of points; empty for others
  bool isNear(int leaf, int other) const;
};

/// `points`: positions of the points in the order of `order`, mm; `nodes`: of the functions, in
/// their own order. Throws Cancelled.
BlockDivision divideBlocks(const CompressedOrder& order, const ExactRows& exact,
                           const ElementSurface& surface,
                           const std::vector<Eigen::Vector3d>& points,
                           const std::vector<Eigen::Vector3d>& nodes, const Job& job);

}  // namespace palpa::bem
