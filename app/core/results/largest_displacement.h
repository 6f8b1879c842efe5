#pragma once

#include <Eigen/Core>

#include "app/core/model/touch_model.h"

namespace palpa::app {

/// The largest displacement of the nodes of a mesh.
struct LargestDisplacement {
  double length = 0;                             ///< mm
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< mm, of the node at rest
};

/// Of a state of the model; 0 if nothing moves.
LargestDisplacement largestDisplacement(const TouchModel& model, const TouchState& state);

}  // namespace palpa::app
