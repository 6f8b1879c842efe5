#pragma once

#include "bem/model/triangle_tree.h"

namespace palpa::bem {

/// Newton's method over the points of a mesh, from `start`. `stepFrom(point)` returns the step as
/// changes of the weights of the triangle's second and third corner; no step is longer than `scale`
/// mm. A step that leaves its triangle continues at the nearest point of the mesh. Ends when steps
/// are below 1e-12 of the scale.
template <class StepFrom>
SurfacePoint walkToFoot(const BoundaryMesh& mesh, const TriangleTree& tree,
                        const SurfacePoint& start, double scale, const StepFrom& stepFrom) {
  constexpr int kMaxSteps = 16;
  constexpr double kEnough = 1e-12, kMargin = 1e-6;
  SurfacePoint at = start;
  for (int step = 0; step < kMaxSteps; ++step) {
    const auto& c = mesh.triangles[at.triangle];
    Eigen::Vector2d by = stepFrom(at);
    const Eigen::Vector3d& origin = mesh.nodes[c[0]];
    const Eigen::Vector3d ab = mesh.nodes[c[1]] - origin;
    const Eigen::Vector3d ac = mesh.nodes[c[2]] - origin;
    const double length = (by[0] * ab + by[1] * ac).norm();
    if (length > scale) by *= scale / length;
    const Eigen::Vector3d before = at.position;
    const Eigen::Vector3d weights = at.weights + Eigen::Vector3d(-by[0] - by[1], by[0], by[1]);
    if (weights.minCoeff() >= 0) {
      at.weights = weights;
      at.position = mesh.point(at.triangle, weights);
    } else {
      // The mesh is no farther than `before`; the margin covers rounding errors.
      const Eigen::Vector3d target = before + by[0] * ab + by[1] * ac;
      at = tree.nearest(target, (target - before).norm() + kMargin * scale);
      if (at.triangle < 0) at = tree.nearest(target);  // `start` was not on the mesh
    }
    if ((at.position - before).norm() <= kEnough * scale) break;
  }
  return at;
}

}  // namespace palpa::bem
