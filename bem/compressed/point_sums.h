#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <vector>

#include "bem/compressed/compressed_order.h"

namespace palpa::bem {

/// The rows that are stored: single points, or sums over points of a leaf with their weights in one
/// equation. Elements over thin walls have seven points for about two nodes, so that sums take half
/// of the memory of points.
class PointSums {
 public:
  PointSums() = default;
  /// `order`: of the points, which must outlive this.
  PointSums(const CompressedOrder& order, const WeightedEquations& equations);

  using Weights = Eigen::SparseMatrix<float, Eigen::RowMajor>;
  /// The same order with rows instead of points.
  const CompressedOrder& order() const { return rows_; }
  /// Points of a row: (row, position of the point).
  const Weights& points() const { return points_; }
  /// (equation, row)
  const Weights& weights() const { return weights_; }

  /// True if some rows of a cluster are sums.
  bool hasSums(int cluster) const { return rows_.rows(cluster) != order_->rows(cluster); }
  /// The rows of a leaf, three numbers each, from the rows of its points.
  Eigen::MatrixXf sum(int leaf, Eigen::MatrixXf ofPoints) const;

 private:
  const CompressedOrder* order_ = nullptr;
  CompressedOrder rows_;
  Weights points_, weights_;
};

}  // namespace palpa::bem
