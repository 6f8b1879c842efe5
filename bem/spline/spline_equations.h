#pragma once

#include <Eigen/Sparse>
#include <span>
#include <vector>

#include "bem/spline/spline_collocation.h"

namespace palpa::bem {

/// Equations for the unknowns: one per displacement coefficient, then one per extra traction slot
/// (DegreesOfFreedom::extraSlots()). Equation k requires
///   Σ_i weights(k, i) r(x_i) = 0
/// for the residuals r of the boundary integral equation at points x_i.
///
/// Most equations are collocation equations: one point of weight 1. Functions cut by the border of
/// a support (SplineSurface::isTorn) keep pieces of arbitrary shape, for which no choice of single
/// points is safe: with Greville points moved to the side of the piece, errors were up to a hundred
/// times larger and condition numbers reached 1e13. Their equations are Galerkin equations, ∫ N_k r
/// dΓ = 0 over the side of the piece with the Gauss points of its elements. The solution is then as
/// accurate as the functions can represent it, for any border.
struct SplineEquations {
  std::vector<SplineCollocationPoint> points;
  Eigen::SparseMatrix<double> weights;  ///< (equation, point); the weights of a row sum to 1
  /// True if every equation has exactly one point.
  bool isCollocation() const { return weights.nonZeros() == weights.rows(); }
  /// The given equations alone, with the points that they need.
  SplineEquations only(std::span<const int> equations) const;
};

/// Equations for a surface and its tractions; `extraSlots` as DegreesOfFreedom::extraSlots().
SplineEquations splineEquations(const SplineSurface& surface, const SplineTractions& tractions,
                                std::span<const int> extraSlots);

}  // namespace palpa::bem
