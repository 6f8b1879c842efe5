#include "bem/linalg/row_choice.h"

#include <cblas.h>

#include <cmath>

namespace palpa::bem {

using Eigen::Index;
using Eigen::MatrixXf;
using Eigen::VectorXf;

RowChoice chooseRows(RowMatrixXf A, float tolerance) {
  const auto rows = static_cast<int>(A.rows()), columns = static_cast<int>(A.cols());
  RowChoice choice;
  const int most = std::min(rows, columns);
  MatrixXf factors(rows, most);  // A ≈ factors * orthonormal rows
  float smallest = 0;
  int rank = 0;
  VectorXf direction(columns);
  for (; rank < most; ++rank) {
    Index pivot = 0;
    // Squares of lengths, from the rests themselves: differences of squares would have no digits.
    const float largest = A.rowwise().squaredNorm().maxCoeff(&pivot);
    if (rank == 0) smallest = tolerance * tolerance * largest;
    if (!(largest > smallest)) break;
    direction = A.row(pivot).transpose() / std::sqrt(largest);
    direction.normalize();
    float* factor = factors.col(rank).data();
    cblas_sgemv(CblasRowMajor, CblasNoTrans, rows, columns, 1, A.data(), columns, direction.data(),
                1, 0, factor, 1);
    cblas_sger(CblasRowMajor, rows, columns, -1, factor, 1, direction.data(), 1, A.data(), columns);
    A.row(pivot).setZero();
    choice.rows.push_back(static_cast<int>(pivot));
  }
  MatrixXf chosen(rank, rank);  // lower triangular in the order of the choice
  for (int k = 0; k < rank; ++k) chosen.row(k) = factors.row(choice.rows[k]).head(rank);
  choice.weights = factors.leftCols(rank);
  if (rank > 0)
    cblas_strsm(CblasColMajor, CblasRight, CblasLower, CblasNoTrans, CblasNonUnit, rows, rank, 1,
                chosen.data(), rank, choice.weights.data(), rows);
  return choice;
}

}  // namespace palpa::bem
