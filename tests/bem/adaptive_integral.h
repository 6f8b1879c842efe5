#pragma once

#include <Eigen/Dense>
#include <array>

#include "bem/model/material.h"

namespace palpa::bem::test {

using Corners = std::array<Eigen::Vector3d, 3>;

/// Integrals of Kelvin's kernels against the three linear basis functions of a triangle.
struct ElementBlocks {
  Eigen::Matrix3d U[3], T[3];
};

/// Reference integrals by brute force: the triangle is bisected across its longest edge until every
/// piece is small compared with its distance from `x`, and a 100-point product Gauss rule of degree
/// 18 is applied to the pieces. Independent of the closed form and the rules of bem/. Relative
/// error below 1e-11 for a point at least 1e-4 of the triangle's size away from it.
ElementBlocks integrateAdaptively(const Corners& corners, const Eigen::Vector3d& x,
                                  const Material& material);

/// Reference integrals for a point inside the triangle (not on its border): U as above with the
/// weak singularity resolved to 1e-12, and T as a principal value. In the plane only the
/// antisymmetric part of T remains, and with N(y) = N(x) + g.ρ
///   PV ∫ N r/R^3 = ∫ (N - N(x)) r/R^3 + N(x) PV ∫ r/R^3,   PV ∫ r/R^3 = -∮ m/R ds,
/// m the outward normal of the border in the plane.
ElementBlocks integrateInPlace(const Corners& corners, const Eigen::Vector3d& x,
                               const Material& material);

}  // namespace palpa::bem::test
