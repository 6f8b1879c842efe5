#pragma once

#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "bem/element/element_surface.h"

namespace palpa::bem {

/// Equations of the boundary integral equation: each is a weighted mean of its residual at points
/// of the surface, one point for collocation.
struct WeightedEquations {
  std::vector<CollocationPlace> points;
  Eigen::SparseMatrix<double> weights;  ///< (equation, point); the weights of a row sum to 1
  /// True if every equation has exactly one point.
  bool isCollocation() const { return weights.nonZeros() == weights.rows(); }
  /// The given equations alone, with the points that they need.
  WeightedEquations only(std::span<const int> equations) const;
};

/// One equation per point.
WeightedEquations collocationEquations(std::vector<CollocationPlace> points);

}  // namespace palpa::bem
