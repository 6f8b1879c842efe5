#include "bem/model/triangle_tree.h"

#include <limits>

namespace palpa::bem {

TriangleTree::TriangleTree(const BoundaryMesh& mesh)
    : mesh_(mesh),
      boxes_(triangleBoxes(mesh.nodes, mesh.triangles)),
      tree_(triangleTree(mesh.nodes, mesh.triangles, boxes_)) {}

SurfacePoint TriangleTree::nearest(const Eigen::Vector3d& point) const {
  return nearest(point, std::numeric_limits<double>::infinity());
}

SurfacePoint TriangleTree::nearest(const Eigen::Vector3d& point, double reach) const {
  SurfacePoint best{-1, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                    std::numeric_limits<double>::infinity()};
  tree_.visitNear(point, reach, [&](int triangle, double within) {
    // Far cheaper than the search in the triangle.
    if (boxes_[triangle].squaredExteriorDistance(point) >= within * within) return within;
    const SurfacePoint found = nearestOnTriangle(mesh_, triangle, point);
    if (found.distance >= within) return within;
    best = found;
    return best.distance;
  });
  return best;
}

}  // namespace palpa::bem
