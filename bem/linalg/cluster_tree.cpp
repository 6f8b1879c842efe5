#include "bem/linalg/cluster_tree.h"

#include <algorithm>
#include <numeric>

#include "base/byte_reader.h"

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
    : order_(places.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  const auto n = static_cast<int>(places.size());
  while ((n + countOf(levels_ - 1) - 1) / countOf(levels_ - 1) > leafSize) ++levels_;
  setClusters();
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
  }
  setPositions();
}

void ClusterTree::setClusters() {
  clusters_.resize(static_cast<std::size_t>(firstOf(levels_)));
  clusters_[0] = {0, static_cast<int>(order_.size())};
  for (int c = 0; c < firstOf(levels_ - 1); ++c) {
    const auto [begin, end] = clusters_[c];
    const int middle = begin + (end - begin) / 2;
    clusters_[2 * static_cast<std::size_t>(c) + 1] = {begin, middle};
    clusters_[2 * static_cast<std::size_t>(c) + 2] = {middle, end};
  }
}

void ClusterTree::setPositions() {
  positionOf_.assign(order_.size(), -1);
  leafOfPosition_.resize(order_.size());
  for (int c = firstOf(levels_ - 1); c < count(); ++c)
    for (int k = clusters_[c].begin; k < clusters_[c].end; ++k) leafOfPosition_[k] = c;
  for (std::size_t k = 0; k < order_.size(); ++k) positionOf_[order_[k]] = static_cast<int>(k);
}

void ClusterTree::write(const ByteSink& sink) const {
  writeValue(sink, levels_);
  writeList(sink, order_);
}

ClusterTree::ClusterTree(const ByteSource& source) : levels_(readValue<int>(source)) {
  constexpr int kMaxLevels = 28;
  order_ = readList<int>(source);
  const auto n = static_cast<int>(order_.size());
  if (levels_ < 1 || levels_ > kMaxLevels || countOf(levels_ - 1) > std::max(n, 1) ||
      std::any_of(order_.begin(), order_.end(), [n](int k) { return k < 0 || k >= n; }))
    throw DamagedData();
  setClusters();
  setPositions();
}

int ClusterTree::levelOfSize(int size) const {
  int level = 0;
  while (level + 1 < levels_ && clusters_[0].size() / countOf(level + 1) >= size) ++level;
  return level;
}

}  // namespace palpa::bem
