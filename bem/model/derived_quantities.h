#pragma once

#include <Eigen/Core>

namespace palpa::bem {

/// Net force and net moment of tractions.
struct Resultant {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< N
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< N mm, about the origin
};

/// State at a point inside the body.
struct InteriorState {
  Eigen::Vector3d displacement;  ///< mm
  Eigen::Matrix3d stress;        ///< MPa
};

}  // namespace palpa::bem
