#include "bem/model/triangle_tree.h"

#include <limits>

namespace palpa::bem {

TriangleTree::TriangleTree(const BoundaryMesh& mesh)
    : mesh_(mesh),
      tree_(triangleTree(mesh.nodes, mesh.triangles, triangleBoxes(mesh.nodes, mesh.triangles))) {}

SurfacePoint TriangleTree::nearest(const Eigen::Vector3d& point) const {
  SurfacePoint best{-1, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                    std::numeric_limits<double>::infinity()};
  tree_.visitNear(point, best.distance, [&](int triangle, double) {
    const SurfacePoint found = nearestOnTriangle(mesh_, triangle, point);
    if (found.distance < best.distance) best = found;
    return best.distance;
  });
  return best;
}

}  // namespace palpa::bem
