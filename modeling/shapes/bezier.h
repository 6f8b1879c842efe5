#pragma once

#include <Eigen/Core>
#include <vector>

namespace palpa::modeling {

/// Control points of the same Bézier curve with one degree more: n + 1 of n, with
///   q_i = i / n p_(i-1) + (1 - i / n) p_i
/// (Piegl and Tiller, The NURBS Book, section 5.5).
inline std::vector<Eigen::Vector2d> elevatedOnce(const std::vector<Eigen::Vector2d>& points) {
  const double count = static_cast<double>(points.size());
  std::vector<Eigen::Vector2d> result{points.front()};
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double share = static_cast<double>(i) / count;
    result.push_back(share * points[i - 1] + (1.0 - share) * points[i]);
  }
  result.push_back(points.back());
  return result;
}

}  // namespace palpa::modeling
