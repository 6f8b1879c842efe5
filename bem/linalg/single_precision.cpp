#include "bem/linalg/single_precision.h"

#include <lapacke.h>

#include <random>

namespace palpa::bem {

using Eigen::Index;
using Eigen::MatrixXf;

void multiply(bool transposeA, bool transposeB, float alpha, const MatrixXf& A, const MatrixXf& B,
              float beta, MatrixXf& C) {
  const Index rows = transposeA ? A.cols() : A.rows(), inner = transposeA ? A.rows() : A.cols(),
              columns = transposeB ? B.rows() : B.cols();
  if (beta == 0) C.resize(rows, columns);
  if (rows == 0 || columns == 0) return;
  if (beta == 0 && (inner == 0 || columns <= kFewColumns)) C.setZero();
  if (inner == 0) return;
  if (columns <= kFewColumns && !transposeB) {
    for (Index c = 0; c < columns; ++c)
      cblas_sgemv(CblasColMajor, transposeA ? CblasTrans : CblasNoTrans, static_cast<int>(A.rows()),
                  static_cast<int>(A.cols()), alpha, A.data(), static_cast<int>(A.rows()),
                  B.col(c).data(), 1, beta, C.col(c).data(), 1);
    return;
  }
  cblas_sgemm(CblasColMajor, transposeA ? CblasTrans : CblasNoTrans,
              transposeB ? CblasTrans : CblasNoTrans, static_cast<int>(rows),
              static_cast<int>(columns), static_cast<int>(inner), alpha, A.data(),
              static_cast<int>(A.rows()), B.data(), static_cast<int>(B.rows()), beta, C.data(),
              static_cast<int>(C.rows()));
}

MatrixXf randomMatrix(Index rows, Index columns, unsigned seed) {
  std::minstd_rand generator(seed + 1);
  MatrixXf matrix(rows, columns);
  const float range = static_cast<float>(std::minstd_rand::max());
  for (Index k = 0; k < matrix.size(); ++k) {
    // The sum of some uniform numbers is nearly normal, with variance 1 here.
    float sum = 0;
    for (int j = 0; j < 3; ++j) sum += 2 * static_cast<float>(generator()) / range - 1;
    matrix.data()[k] = sum;
  }
  return matrix;
}

void orthonormalise(MatrixXf& matrix) {
  const auto rows = static_cast<lapack_int>(matrix.rows()),
             columns = static_cast<lapack_int>(matrix.cols());
  std::vector<float> tau(static_cast<std::size_t>(columns));
  LAPACKE_sgeqrf(LAPACK_COL_MAJOR, rows, columns, matrix.data(), rows, tau.data());
  LAPACKE_sorgqr(LAPACK_COL_MAJOR, rows, columns, columns, matrix.data(), rows, tau.data());
}

void solveTriangular(CBLAS_SIDE side, CBLAS_UPLO part, bool isTransposed, bool hasUnits,
                     const MatrixXf& triangle, MatrixXf& x) {
  if (x.size() == 0) return;
  const auto rows = static_cast<int>(triangle.rows());
  const auto transposed = isTransposed ? CblasTrans : CblasNoTrans;
  const auto diagonal = hasUnits ? CblasUnit : CblasNonUnit;
  if (side == CblasLeft && x.cols() <= kFewColumns) {
    for (Index c = 0; c < x.cols(); ++c)
      cblas_strsv(CblasColMajor, part, transposed, diagonal, rows, triangle.data(), rows,
                  x.col(c).data(), 1);
    return;
  }
  cblas_strsm(CblasColMajor, side, part, transposed, diagonal, static_cast<int>(x.rows()),
              static_cast<int>(x.cols()), 1, triangle.data(), rows, x.data(),
              static_cast<int>(x.rows()));
}

void swapRows(const std::vector<int>& pivots, MatrixXf& x, bool isForward) {
  if (x.cols() == 0) return;
  LAPACKE_slaswp_work(LAPACK_COL_MAJOR, static_cast<lapack_int>(x.cols()), x.data(),
                      static_cast<lapack_int>(x.rows()), 1, static_cast<lapack_int>(pivots.size()),
                      pivots.data(), isForward ? 1 : -1);
}

}  // namespace palpa::bem
