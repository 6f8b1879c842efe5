#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "app/core/design/design_surface.h"
#include "app/core/results/drawn_body.h"

namespace palpa::app {

/// The derivative of a stiffness by material added at the surface, from its derivative by the
/// control points: at a point with the normal n and the functions N_j
///
///     Σ_j N_j (G_j·n) / (∂V/∂P_j·n)
///
/// with the gradients G_j of the stiffness and ∂V/∂P_j of the volume: the change of the stiffness
/// over the change of the volume when the control points that reach the point move along its
/// normal. So it does not depend on the density of the net, and is as fine as the net. Immutable.
class SurfaceGradient {
 public:
  /// Both of one model, whose body is a solid. About 2 µs per point.
  SurfaceGradient(const DesignSurface& surface, const DrawnBody& drawn);

  /// One number per point of the drawn body, N/mm per cm³. `gradient`: N/mm per mm, one column per
  /// control point.
  std::vector<double> values(const Eigen::Matrix3Xd& gradient) const;

 private:
  struct Weight {
    int controlPoint;
    double value;  ///< 1/mm²
  };
  std::vector<Eigen::Vector3d> normals_;
  std::vector<std::size_t> first_{0};
  std::vector<Weight> weights_;
};

/// End of a scale of colours that is symmetric about zero: a round number that 97 % of the values
/// do not exceed, as gradients peak beside touches and supports. 1 without values.
double surfaceGradientEnd(const std::vector<double>& values);

}  // namespace palpa::app
