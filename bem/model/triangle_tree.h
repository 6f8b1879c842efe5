#pragma once

#include "base/box_tree.h"
#include "bem/model/surface_point.h"

namespace palpa::bem {

/// Finds the surface point nearest to a place without looking at every triangle. Immutable; const
/// use from several threads is safe. `mesh` must outlive it.
class TriangleTree {
 public:
  explicit TriangleTree(const BoundaryMesh& mesh);

  /// As nearestSurfacePoint(), in microseconds instead of milliseconds. Does not allocate.
  SurfacePoint nearest(const Eigen::Vector3d& point) const;
  /// The same point, sooner, for a surface that is known to be nearer than `reach` (mm). If it is
  /// not, the triangle is -1.
  SurfacePoint nearest(const Eigen::Vector3d& point, double reach) const;

 private:
  const BoundaryMesh& mesh_;
  std::vector<BoxTree::Box> boxes_;
  BoxTree tree_;
};

}  // namespace palpa::bem
