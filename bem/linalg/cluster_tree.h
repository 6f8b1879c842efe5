#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "base/byte_stream.h"

namespace palpa::bem {

/// Ball about some points, mm.
struct Ball {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0;
};
/// About the centre of gravity of the points.
Ball ballAround(std::span<const Eigen::Vector3d> points);

/// Complete binary tree of clusters of places: each cluster is halved across the direction in which
/// its places spread most, so that all clusters of a level have the same number of places, up to
/// one. Clusters are numbered level by level: 0 is the whole body, the sons of c are 2 c + 1 and
/// 2 c + 2. The places of a cluster are consecutive in order().
class ClusterTree {
 public:
  ClusterTree() = default;
  /// Leaves have at most `leafSize` places.
  ClusterTree(const std::vector<Eigen::Vector3d>& places, int leafSize);
  /// Reads what write() wrote. Throws DamagedData, and what the source throws.
  explicit ClusterTree(const ByteSource& source);
  void write(const ByteSink& sink) const;

  struct Cluster {
    int begin, end;  ///< positions in order()
    int size() const { return end - begin; }
  };
  int levelCount() const { return levels_; }
  int count() const { return static_cast<int>(clusters_.size()); }
  const Cluster& cluster(int index) const { return clusters_[index]; }
  /// Index of the first cluster of a level, which has as many clusters.
  static int firstOf(int level) { return (1 << level) - 1; }
  static int countOf(int level) { return 1 << level; }
  bool isLeaf(int index) const { return index >= firstOf(levels_ - 1); }
  /// Leaf cluster of a position.
  int leafOf(int position) const { return leafOfPosition_[position]; }
  /// Deepest level whose clusters have at least `size` places; 0 if there is none.
  int levelOfSize(int size) const;

  const std::vector<int>& order() const { return order_; }            ///< places by position
  const std::vector<int>& positionOf() const { return positionOf_; }  ///< of each place

 private:
  void setClusters();
  void setPositions();

  int levels_ = 1;
  std::vector<Cluster> clusters_;
  std::vector<int> order_, positionOf_, leafOfPosition_;
};

}  // namespace palpa::bem
