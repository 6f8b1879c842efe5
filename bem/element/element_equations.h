#pragma once

#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "bem/element/element_surface.h"

namespace palpa::bem {

/// An element over which the residual is averaged with weights. Near elements are integrated at the
/// points of a rule. The kernels of the others vary smoothly over the element, and are integrated
/// at its nodes and interpolated.
struct AveragedElement {
  int element;                           ///< index in the surface
  std::vector<CollocationPlace> points;  ///< of the rule, mm
  std::vector<int> equations;            ///< those with weights here
  Eigen::MatrixXd weights;               ///< (equation, point)
  std::vector<int> nodes;                ///< indices of WeightedEquations::points
  Eigen::MatrixXd
      interpolated;       ///< (node, point): values at the points are interpolated with these
  std::vector<int> near;  ///< elements, ascending
};

/// Equations of the boundary integral equation: each is a weighted mean of its residual at points
/// of the surface, one point for collocation.
struct WeightedEquations {
  std::vector<CollocationPlace> points;
  Eigen::SparseMatrix<double> weights;  ///< (equation, point); the weights of a row sum to 1
  /// Their nodes are points, too, whose weights hold for far elements only. No such point is also a
  /// collocation point.
  std::vector<AveragedElement> averaged;
  /// True if every equation has exactly one point.
  bool isCollocation() const { return averaged.empty() && weights.nonZeros() == weights.rows(); }
  /// The given equations alone, with the points that they need.
  WeightedEquations only(std::span<const int> equations) const;
};

/// Adds the points of an element's rule and their weights (equation, point) in its equations.
void addPoints(const AveragedElement& element, std::vector<CollocationPlace>& points,
               std::vector<Eigen::Triplet<double>>& weights);

/// Adds the weights of averaged elements for their far elements: `averaged` of the equations is
/// set, `weights` (equation, point) are the weights of the other points, which may be repeated.
/// `equationCount`: number of all equations.
void setWeights(WeightedEquations& equations, Eigen::Index equationCount,
                std::vector<Eigen::Triplet<double>> weights);

/// The same equations with all means taken over points: nothing is interpolated between nodes.
WeightedEquations atPoints(const WeightedEquations& equations);

/// One equation per point.
WeightedEquations collocationEquations(std::vector<CollocationPlace> points);

}  // namespace palpa::bem
