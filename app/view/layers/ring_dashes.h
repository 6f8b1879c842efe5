#pragma once

#include <Eigen/Core>
#include <vector>

/// Dashed rings. Internal to app/view; pure arithmetic.
namespace palpa::view {

/// Cuts the closed polyline into `count` dashes of equal length that cover `share` (0 … 1) of it,
/// each a polyline; the whole ring as one closed polyline where the share is 1. Empty if the ring
/// has no length or a coordinate that is not finite.
std::vector<std::vector<Eigen::Vector3d>> ringDashes(const std::vector<Eigen::Vector3d>& ring,
                                                     int count, double share);

}  // namespace palpa::view
