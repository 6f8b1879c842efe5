#pragma once

#include <Eigen/Sparse>
#include <span>
#include <vector>

#include "bem/spline/spline_collocation.h"

namespace palpa::bem {

/// The equations for the unknowns: one per displacement coefficient, then one per extra traction
/// slot (DegreesOfFreedom::extraSlots()). Equation k demands that
///   Σ_i weights(k, i) r(x_i) = 0
/// of the residuals r of the boundary integral equation at points x_i.
///
/// Mostly that is collocation: one point each, of weight 1. But functions that the border of a
/// support cuts (SplineSurface::isTorn) are left with pieces of any shape, for which no choice of
/// single points is safe: with Greville points moved to their own side, errors were up to a hundred
/// times larger and condition numbers reached 1e13. Theirs are Galerkin's equations, ∫ N_k r dΓ = 0
/// over their own side by Gauss points of its elements, whose solution is as good as the functions
/// are able to express it, wherever the border runs.
struct SplineEquations {
  std::vector<SplineCollocationPoint> points;
  Eigen::SparseMatrix<double> weights;  ///< (equation, point); rows add up to 1
  /// One point per equation.
  bool isCollocation() const { return weights.nonZeros() == weights.rows(); }
  /// Some of them, with the points that they need.
  SplineEquations only(std::span<const int> equations) const;
};

SplineEquations splineEquations(const SplineSurface& surface, const SplineTractions& tractions,
                                std::span<const int> extraSlots);

}  // namespace palpa::bem
