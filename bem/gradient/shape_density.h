#pragma once

#include <Eigen/Dense>

namespace palpa::bem {

/// Derivative of a number by the motion V (mm) of the surface:
///   Σ_q [ value_q · V(x_q) + Σ_a slope_qa · ∂V/∂t_a(x_q) ] + Σ_m centre_m · V(c_m)
/// over the points of a FieldSampler, with the tangents t_a of their frames, and over the centres
/// of masks. All of the surface is material: V also moves it along itself.
struct ShapeDensity {
  Eigen::Matrix3Xd value;  ///< one column per point
  Eigen::Matrix3Xd slope;  ///< two columns per point
  explicit ShapeDensity(int points)
      : value(Eigen::Matrix3Xd::Zero(3, points)), slope(Eigen::Matrix3Xd::Zero(3, 2 * points)) {}

  /// The derivative for a motion that is given at the points; for tests.
  double along(const Eigen::Matrix3Xd& motion, const Eigen::Matrix3Xd& slopes) const {
    return value.cwiseProduct(motion).sum() + slope.cwiseProduct(slopes).sum();
  }
};

}  // namespace palpa::bem
