#pragma once

#include <functional>
#include <vector>

#include "modeling/editing/command.h"

namespace palpa::modeling {

/// Displacement (mm) of a control point that follows `leader`, the nearest selected point. A
/// selected point is its own leader.
using Motion = std::function<Eigen::Vector3d(int point, int leader)>;

/// The solid after a motion of the selected points and of the points within reach. Smooth edges
/// remain tangent-continuous.
/// Throws ModelingError if the reach is invalid, a point has no mirror image, coordinates are out
/// of range, or the solid is turned inside out.
Solid movePoints(const Solid& solid, const std::vector<int>& selected, const Reach& reach,
                 const Motion& motion);

}  // namespace palpa::modeling
