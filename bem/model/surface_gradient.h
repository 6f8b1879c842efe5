#pragma once

#include <Eigen/Dense>

#include "bem/model/material.h"

namespace palpa::bem {

/// Gradient of the displacement at a surface point (column j is the derivative along axis j) from
/// its derivatives `along` two tangents and the traction (MPa), by Hooke's law; regular at nu =
/// 0.5. `frame`: two tangents and the outward normal as columns. Tangential tractions give
/// p_a = G (u_a,n + u_n,a), the normal one p_n = 2 G [e_nn + nu / (1 - 2 nu) e_kk] (Brebbia, Telles
/// & Wrobel, sect. 5.8).
inline Eigen::Matrix3d surfaceGradient(const Eigen::Matrix3d& frame,
                                       const Eigen::Matrix<double, 3, 2>& along,
                                       const Eigen::Vector3d& traction, const Material& material) {
  const double nu = material.poissonRatio, shear = material.shear();
  const Eigen::Vector3d inFrame = frame.transpose() * traction;
  Eigen::Matrix3d local;
  local.leftCols<2>() = frame.transpose() * along;
  for (int a = 0; a < 2; ++a) local(a, 2) = inFrame[a] / shear - local(2, a);
  local(2, 2) =
      ((1 - 2 * nu) * inFrame[2] / (2 * shear) - nu * (local(0, 0) + local(1, 1))) / (1 - nu);
  return frame * local * frame.transpose();
}

}  // namespace palpa::bem
