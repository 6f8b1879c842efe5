#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace palpa::modeling {

/// Cosine of the angle at a between b and c, clamped to [-1, 1]; 1 for a degenerate triangle.
inline double cornerCosine(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                           const Eigen::Vector3d& c) {
  const Eigen::Vector3d p = b - a;
  const Eigen::Vector3d q = c - a;
  const double lengths = std::sqrt(p.squaredNorm() * q.squaredNorm());
  return lengths > 0.0 ? std::clamp(p.dot(q) / lengths, -1.0, 1.0) : 1.0;
}

/// Cosine of the angle between two vectors; 0 if one of them is zero.
inline double cosineBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double lengths = a.norm() * b.norm();
  return lengths > 0.0 ? a.dot(b) / lengths : 0.0;
}

/// Smallest angle of a triangle in radians.
inline double smallestAngle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                            const Eigen::Vector3d& c) {
  return std::acos(std::max({cornerCosine(a, b, c), cornerCosine(b, c, a), cornerCosine(c, a, b)}));
}

}  // namespace palpa::modeling
