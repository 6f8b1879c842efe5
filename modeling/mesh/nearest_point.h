#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

namespace palpa::modeling {

/// Nearest points on a set of triangles or of line segments, by a tree of boxes (CGAL). The set may
/// be empty: then distances are infinite and points are their own nearest. Immutable after
/// construction; const use from several threads is safe.
class NearestOnTriangles {
 public:
  explicit NearestOnTriangles(const std::vector<std::array<Eigen::Vector3d, 3>>& triangles);
  Eigen::Vector3d nearest(const Eigen::Vector3d& point) const;

 private:
  struct Tree;
  std::shared_ptr<const Tree> tree_;
};

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
