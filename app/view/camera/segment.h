#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace palpa::view {

/// From `point` to the segment between `a` and `b`.
inline double distanceToSegment(const Eigen::Vector2d& point, const Eigen::Vector2d& a,
                                const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double lengthSquared = along.squaredNorm();
  const double t =
      lengthSquared > 0 ? std::clamp(along.dot(point - a) / lengthSquared, 0.0, 1.0) : 0.0;
  return (point - a - t * along).norm();
}

}  // namespace palpa::view
