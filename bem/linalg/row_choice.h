#pragma once

#include <Eigen/Dense>
#include <vector>

namespace palpa::bem {

using RowMatrixXf = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Rows of a matrix from which all rows are interpolated: A ≈ weights * A(rows, :).
struct RowChoice {
  std::vector<int> rows;
  Eigen::MatrixXf weights;  ///< (row of A, chosen row)
};

/// Chooses rows by Gram-Schmidt orthogonalisation, the row with the largest rest first, until all
/// rests are smaller than `tolerance` times the largest row (an interpolative decomposition; Cheng,
/// Gimbutas, Martinsson and Rokhlin 2005). Every entry of A is looked at, so that rows or columns
/// of zeros do not end the choice early.
RowChoice chooseRows(RowMatrixXf A, float tolerance);

}  // namespace palpa::bem
