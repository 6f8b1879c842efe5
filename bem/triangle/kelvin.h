#pragma once

#include <Eigen/Dense>

#include "bem/model/material.h"

namespace palpa::bem {

/// Kelvin's solution for a point force in an infinite elastic body, evaluated point by point. The
/// assembly uses the batched integrals of `flat_triangle.h`; these functions serve checks, interior
/// points and the baseline of the benchmark.
///
/// With r = y - x, R = |r|, e = r / R, n the unit outward normal at y (Brebbia, Telles & Wrobel,
/// Boundary Element Techniques, 1984, eqs 5.9 and 5.10):
///   U_ij = 1 / (16 pi G (1 - nu) R) [ (3 - 4 nu) delta_ij + e_i e_j ]
///   T_ij = -1 / (8 pi (1 - nu) R^2) { (e.n) [ (1 - 2 nu) delta_ij + 3 e_i e_j ] - (1 - 2 nu)(e_i
///   n_j - e_j n_i) }
/// U is in mm/N, T in 1/mm^2. Both stay finite at nu = 0.5. Precondition: x != y.

/// Displacement in direction j at y by a unit force in direction i at x.
Eigen::Matrix3d kelvinDisplacement(const Eigen::Vector3d& x, const Eigen::Vector3d& y,
                                   const Material& material);

/// Traction in direction j at y on the surface element with normal n by a unit force in direction i
/// at x.
Eigen::Matrix3d kelvinTraction(const Eigen::Vector3d& x, const Eigen::Vector3d& y,
                               const Eigen::Vector3d& n, const Material& material);

/// Kernels of the stress at the interior point x (same source, eqs 5.44 and 5.45): sigma = ∫ D p dΓ
/// - ∫ S u dΓ. The first function returns the contribution of the traction p at y, the second one
/// of the displacement u at y (including the minus sign), both per unit area, MPa/mm^2.
Eigen::Matrix3d kelvinStressFromTraction(const Eigen::Vector3d& x, const Eigen::Vector3d& y,
                                         const Eigen::Vector3d& p, const Material& material);
Eigen::Matrix3d kelvinStressFromDisplacement(const Eigen::Vector3d& x, const Eigen::Vector3d& y,
                                             const Eigen::Vector3d& n, const Eigen::Vector3d& u,
                                             const Material& material);

}  // namespace palpa::bem
