#include "bem/compressed/block_division.h"

#include <algorithm>
#include <span>

#include "bem/element/skeleton.h"

namespace palpa::bem {
namespace {

void divide(const CompressedOrder& order, int row, int column, BlockDivision& division,
            const Job& job) {
  const bool isLeaf = order.tree.isLeaf(row);
  if (isLeaf) job.throwIfCancelled();
  if (order.rows(row) == 0) return;
  if (isDistant(division.pointBalls[row], division.functionBalls[column])) {
    division.far[row].push_back(column);
  } else if (isLeaf) {
    division.near[row].push_back(column);
  } else {
    for (int a = 1; a <= 2; ++a)
      for (int b = 1; b <= 2; ++b) divide(order, 2 * row + a, 2 * column + b, division, job);
  }
}

}  // namespace

bool BlockDivision::isNear(int leaf, int other) const {
  return std::binary_search(near[leaf].begin(), near[leaf].end(), other);
}

BlockDivision divideBlocks(const CompressedOrder& order, const ExactRows& exact,
                           const ElementSurface& surface,
                           const std::vector<Eigen::Vector3d>& points,
                           const std::vector<Eigen::Vector3d>& nodes, const Job& job) {
  BlockDivision division;
  std::vector<Eigen::Vector3d> places;
  for (int c = 0; c < order.tree.count(); ++c) {
    const auto begin = static_cast<std::size_t>(order.pointBegin(c));
    const std::span<const Eigen::Vector3d> ofPoints(
        points.data() + begin, static_cast<std::size_t>(order.pointEnd(c)) - begin);
    division.pointBalls.push_back(ofPoints.empty() ? Ball{} : ballAround(ofPoints));
    places.clear();
    for (const int e : exact.elements(c))
      for (const int node : surface.coefficients(e)) places.push_back(nodes[node]);
    division.functionBalls.push_back(ballAround(places));
  }
  division.far.resize(static_cast<std::size_t>(order.tree.count()));
  division.near.resize(static_cast<std::size_t>(order.tree.count()));
  divide(order, 0, 0, division, job);
  for (auto& list : division.near) std::sort(list.begin(), list.end());
  return division;
}

}  // namespace palpa::bem
