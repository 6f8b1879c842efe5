#pragma once

#include <Eigen/Core>

namespace palpa::modeling {

/// A plane through a point (mm); the normal need not have length 1.
struct MirrorPlane {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();

  bool operator==(const MirrorPlane&) const = default;
};

}  // namespace palpa::modeling
