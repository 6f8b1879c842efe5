#include "bem/linalg/cluster_tree.h"

#include <algorithm>
#include <numeric>

namespace palpa::bem {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Ball ballAround(std::span<const Vector3d> points) {
  Ball ball;
  for (const Vector3d& x : points) ball.centre += x / static_cast<double>(points.size());
  for (const Vector3d& x : points) ball.radius = std::max(ball.radius, (x - ball.centre).norm());
  return ball;
}

ClusterTree::ClusterTree(const std::vector<Vector3d>& places, int leafSize)
    : order_(places.size()), positionOf_(places.size()), leafOfPosition_(places.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  const auto n = static_cast<int>(places.size());
  while ((n + countOf(levels_ - 1) - 1) / countOf(levels_ - 1) > leafSize) ++levels_;
  clusters_.resize(static_cast<std::size_t>(firstOf(levels_)));
  clusters_[0] = {0, n};
  for (int c = 0; c < firstOf(levels_ - 1); ++c) {
    const auto [begin, end] = clusters_[c];
    Vector3d mean = Vector3d::Zero();
    for (int k = begin; k < end; ++k) mean += places[order_[k]] / clusters_[c].size();
    Matrix3d spread = Matrix3d::Zero();
    for (int k = begin; k < end; ++k) {
      const Vector3d d = places[order_[k]] - mean;
      spread += d * d.transpose();
    }
    const Vector3d axis = Eigen::SelfAdjointEigenSolver<Matrix3d>(spread).eigenvectors().col(2);
    const int middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](int a, int b) {
                       const double along = axis.dot(places[a] - places[b]);
                       return along != 0 ? along < 0 : a < b;
                     });
    clusters_[2 * static_cast<std::size_t>(c) + 1] = {begin, middle};
    clusters_[2 * static_cast<std::size_t>(c) + 2] = {middle, end};
  }
  for (int c = firstOf(levels_ - 1); c < count(); ++c)
    for (int k = clusters_[c].begin; k < clusters_[c].end; ++k) leafOfPosition_[k] = c;
  for (int k = 0; k < n; ++k) positionOf_[order_[k]] = k;
}

int ClusterTree::levelOfSize(int size) const {
  int level = 0;
  while (level + 1 < levels_ && clusters_[0].size() / countOf(level + 1) >= size) ++level;
  return level;
}

}  // namespace palpa::bem
