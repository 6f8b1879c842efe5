#pragma once

#include <functional>
#include <span>

#include "app/view/scene/scene.h"

namespace palpa::view {

/// The smallest gradient that has an arrow, over the largest.
inline constexpr double kMinGradientShare = 0.04;
/// The largest gradients have a number beside their arrow.
inline constexpr std::size_t kGradientLabels = 3;

/// Control points that have an arrow, in ascending order: their gradient (one column per point) is
/// at least kMinGradientShare of the largest. Empty if all are zero.
std::vector<int> pointsWithArrows(const Eigen::Matrix3Xd& gradient);

/// Arrows for pointsWithArrows(), at `places` (mm, one per control point). `label`: text for a
/// gradient, N/mm per mm.
LiveArrows gradientArrows(const Eigen::Matrix3Xd& gradient, std::span<const Eigen::Vector3d> places,
                          const std::function<std::string(double)>& label);

}  // namespace palpa::view
