#pragma once

#include <functional>
#include <vector>

#include "modeling/editing/command.h"

namespace palpa::modeling {

/// Displacement (mm) of a control point that follows `leader`, the nearest selected point; itself
/// when it is selected.
using Motion = std::function<Eigen::Vector3d(int point, int leader)>;

/// Moves the selected points and those within reach, and keeps smooth edges tangent-continuous.
/// @throws ModelingError: bad reach, a point without mirror image, coordinates out of range, a
/// solid
///         turned inside out
Solid movePoints(const Solid& solid, const std::vector<int>& selected, const Reach& reach,
                 const Motion& motion);

}  // namespace palpa::modeling
