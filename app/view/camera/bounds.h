#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>

namespace palpa::view {

/// An axis-aligned box around points; empty until the first is added.
struct Bounds {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity());

  void add(const Eigen::Vector3d& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  void add(const Bounds& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  bool empty() const { return low.x() > high.x(); }
  Eigen::Vector3d center() const { return 0.5 * (low + high); }
  Eigen::Vector3d size() const { return high - low; }

  std::array<Eigen::Vector3d, 8> corners() const {
    std::array<Eigen::Vector3d, 8> points;
    for (std::size_t i = 0; i < 8; ++i) {
      points[i] = {i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(),
                   i & 4 ? high.z() : low.z()};
    }
    return points;
  }
};

}  // namespace palpa::view
