#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <utility>

namespace palpa::bench {

/// Ends of the edges whose middles are the nodes 4 … 9 of a tetrahedron.
inline constexpr std::array<std::pair<int, int>, 6> kTetrahedronEdges{
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

/// Derivatives of the barycentric coordinates by the last three of them.
inline Eigen::Matrix<double, 4, 3> barycentricSlopes() {
  Eigen::Matrix<double, 4, 3> slopes;
  slopes << -1, -1, -1, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  return slopes;
}

/// Derivatives of the ten quadratic functions by the last three barycentric coordinates.
inline Eigen::Matrix<double, 10, 3> quadraticSlopes(const Eigen::Vector4d& b) {
  const Eigen::Matrix<double, 4, 3> d = barycentricSlopes();
  Eigen::Matrix<double, 10, 3> slopes;
  for (int k = 0; k < 4; ++k) slopes.row(k) = (4 * b[k] - 1) * d.row(k);
  for (int k = 0; k < 6; ++k) {
    const auto [i, j] = kTetrahedronEdges[k];
    slopes.row(4 + k) = 4 * (b[i] * d.row(j) + b[j] * d.row(i));
  }
  return slopes;
}

struct TetrahedronPoint {
  Eigen::Vector4d barycentric;
  double weight;  ///< of the volume
};

/// One point for linear elements; four for quadratic ones, exact for polynomials of degree 2 and
/// thus for the stiffness of elements with straight edges (Zienkiewicz & Taylor, The Finite Element
/// Method, table 6.3; CalculiX takes the same).
inline std::span<const TetrahedronPoint> tetrahedronRule(bool isQuadratic) {
  constexpr double kNear = 0.58541019662496845,
                   kFar = 0.13819660112501052;  // (5 + 3 √5) / 20, (5 - √5) / 20
  static const TetrahedronPoint kOne[1] = {{Eigen::Vector4d::Constant(0.25), 1}};
  static const TetrahedronPoint kFour[4] = {{{kNear, kFar, kFar, kFar}, 0.25},
                                            {{kFar, kNear, kFar, kFar}, 0.25},
                                            {{kFar, kFar, kNear, kFar}, 0.25},
                                            {{kFar, kFar, kFar, kNear}, 0.25}};
  if (isQuadratic) return kFour;
  return kOne;
}

}  // namespace palpa::bench
