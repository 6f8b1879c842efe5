#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "bem/model/surface_point.h"

namespace palpa::bem {

/// Finds the surface point nearest to a place without looking at every triangle: a tree of
/// axis-parallel boxes. Immutable; const use from several threads is safe. `mesh` must outlive it.
class TriangleTree {
 public:
  explicit TriangleTree(const BoundaryMesh& mesh);

  /// As nearestSurfacePoint(), some microseconds instead of some milliseconds. Does not allocate.
  SurfacePoint nearest(const Eigen::Vector3d& point) const;

  struct Hit {
    int triangle = -1;
    double distance = 0;  ///< along the ray, in lengths of its direction
    Eigen::Vector3d weights = Eigen::Vector3d::Zero();
  };
  /// The first triangle that a ray meets from outside or inside; triangle -1 when there is none.
  Hit firstHit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

 private:
  struct Box {
    Eigen::AlignedBox3d bounds;
    int first = 0;  // of order_ in a leaf; of the left child otherwise, the right one follows
    int count = 0;  // triangles in a leaf; 0 otherwise
  };
  void split(int box, int first, int last);

  const BoundaryMesh& mesh_;
  std::vector<int> order_;
  std::vector<Eigen::Vector3d> middles_;
  std::vector<Box> boxes_;
};

}  // namespace palpa::bem
