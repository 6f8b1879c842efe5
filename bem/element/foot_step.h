#pragma once

#include <Eigen/Dense>

namespace palpa::bem {

/// Position and derivatives up to the second, mm per unit of the local coordinates.
struct SurfaceJet2 {
  Eigen::Vector3d position = Eigen::Vector3d::Zero(), u = Eigen::Vector3d::Zero(),
                  v = Eigen::Vector3d::Zero(), uu = Eigen::Vector3d::Zero(),
                  uv = Eigen::Vector3d::Zero(), vv = Eigen::Vector3d::Zero();
};

/// Newton step towards (tool - x) . x_u = (tool - x) . x_v = 0. If the tool lies beyond the centre
/// of curvature, the step omits the curvature terms.
Eigen::Vector2d stepToFoot(const SurfaceJet2& jet, const Eigen::Vector3d& tool);

}  // namespace palpa::bem
