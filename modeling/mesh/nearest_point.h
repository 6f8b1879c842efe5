#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

namespace palpa::modeling {

/// Search for the nearest point on a set of triangles by a tree of boxes (CGAL). Lengths in mm. For
/// an empty set every point is its own nearest point, and distances are infinite. Immutable;
/// several threads may call it at the same time.
class NearestOnTriangles {
 public:
  explicit NearestOnTriangles(const std::vector<std::array<Eigen::Vector3d, 3>>& triangles);
  NearestOnTriangles(const std::vector<Eigen::Vector3d>& positions,
                     const std::vector<std::array<int, 3>>& triangles);
  Eigen::Vector3d nearest(const Eigen::Vector3d& point) const;
  /// Index of the triangle with that point; -1 for an empty set.
  int nearestTriangle(const Eigen::Vector3d& point) const;
  /// Distance from a point along a unit direction to the first triangle other than `skipped`;
  /// infinite without one.
  double distanceAlong(const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
                       int skipped) const;

 private:
  struct Tree;
  std::shared_ptr<const Tree> tree_;
};

/// The same for a set of line segments.
class NearestOnSegments {
 public:
  explicit NearestOnSegments(const std::vector<std::array<Eigen::Vector3d, 2>>& segments);
  Eigen::Vector3d nearest(const Eigen::Vector3d& point) const;
  double distance(const Eigen::Vector3d& point) const;

 private:
  struct Tree;
  std::shared_ptr<const Tree> tree_;
};

}  // namespace palpa::modeling
