#include "bem/lu_factorisation.h"

#include <cblas.h>
#include <lapacke.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace palpa::bem {
namespace {

/// Columns per panel: wide enough for the speed of the matrix products, narrow enough that a stop
/// request waits no longer than one trailing update.
constexpr lapack_int kPanel = 192;

// One name for both precisions.
lapack_int getrf(lapack_int m, lapack_int n, float* a, lapack_int lda, lapack_int* pivots) {
  return LAPACKE_sgetrf_work(LAPACK_COL_MAJOR, m, n, a, lda, pivots);
}
lapack_int getrf(lapack_int m, lapack_int n, double* a, lapack_int lda, lapack_int* pivots) {
  return LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, m, n, a, lda, pivots);
}
void laswp(lapack_int n, float* a, lapack_int lda, lapack_int k1, lapack_int k2,
           const int* pivots) {
  LAPACKE_slaswp_work(LAPACK_COL_MAJOR, n, a, lda, k1, k2, pivots, 1);
}
void laswp(lapack_int n, double* a, lapack_int lda, lapack_int k1, lapack_int k2,
           const int* pivots) {
  LAPACKE_dlaswp_work(LAPACK_COL_MAJOR, n, a, lda, k1, k2, pivots, 1);
}
void solveUnitLower(int m, int n, const float* a, int lda, float* b) {
  cblas_strsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasUnit, m, n, 1.0F, a, lda, b,
              lda);
}
void solveUnitLower(int m, int n, const double* a, int lda, double* b) {
  cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasUnit, m, n, 1.0, a, lda, b,
              lda);
}
void subtractProduct(int m, int n, int k, const float* a, const float* b, float* c, int lda) {
  cblas_sgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, m, n, k, -1.0F, a, lda, b, lda, 1.0F, c,
              lda);
}
void subtractProduct(int m, int n, int k, const double* a, const double* b, double* c, int lda) {
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, m, n, k, -1.0, a, lda, b, lda, 1.0, c,
              lda);
}
lapack_int getrs(lapack_int n, lapack_int columns, const float* a, const int* pivots, float* b) {
  return LAPACKE_sgetrs_work(LAPACK_COL_MAJOR, 'N', n, columns, a, n, pivots, b, n);
}
lapack_int getrs(lapack_int n, lapack_int columns, const double* a, const int* pivots, double* b) {
  return LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', n, columns, a, n, pivots, b, n);
}
double reciprocalCondition(lapack_int n, const float* a, double norm) {
  float result = 0;
  LAPACKE_sgecon(LAPACK_COL_MAJOR, '1', n, a, n, static_cast<float>(norm), &result);
  return result;
}
double reciprocalCondition(lapack_int n, const double* a, double norm) {
  double result = 0;
  LAPACKE_dgecon(LAPACK_COL_MAJOR, '1', n, a, n, norm, &result);
  return result;
}

}  // namespace

template <class Scalar>
LuFactorisation<Scalar>::LuFactorisation(LargeMatrix<Scalar> matrix, const Job& job)
    : matrix_(std::move(matrix)), pivots_(matrix_.rows()) {
  const auto n = static_cast<lapack_int>(matrix_.rows());
  norm1_ = matrix_.view().cwiseAbs().colwise().sum().maxCoeff();
  Scalar* const a = matrix_.data();
  const auto at = [a, n](lapack_int row, lapack_int column) {
    return a + static_cast<std::ptrdiff_t>(column) * n + row;
  };
  for (lapack_int first = 0; first < n; first += kPanel) {
    job.throwIfCancelled();
    const lapack_int width = std::min(kPanel, n - first), end = first + width;
    const lapack_int info = getrf(n - first, width, at(first, first), n, &pivots_[first]);
    if (info != 0)
      throw SolverError(SolverError::Kind::kSingular,
                        "the system of equations is singular at unknown " +
                            std::to_string(first + info) + " of " + std::to_string(n) +
                            "; check the supports and the mesh for degenerate places");
    for (lapack_int k = first; k < end; ++k) pivots_[k] += first;
    laswp(first, a, n, first + 1, end, pivots_.data());
    if (end < n) {
      laswp(n - end, at(0, end), n, first + 1, end, pivots_.data());
      solveUnitLower(width, n - end, at(first, first), n, at(first, end));
      subtractProduct(n - end, n - end, width, at(end, first), at(first, end), at(end, end), n);
    }
    job.report("factorise", 1.0 - std::pow(1.0 - static_cast<double>(end) / n, 3));
  }
}

template <class Scalar>
void LuFactorisation<Scalar>::solveInPlace(
    Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& rightHandSides) const {
  getrs(static_cast<lapack_int>(size()), static_cast<lapack_int>(rightHandSides.cols()),
        matrix_.data(), pivots_.data(), rightHandSides.data());
}

template <class Scalar>
double LuFactorisation<Scalar>::conditionEstimate() const {
  const double reciprocal =
      reciprocalCondition(static_cast<lapack_int>(size()), matrix_.data(), norm1_);
  return reciprocal > 0 ? 1.0 / reciprocal : std::numeric_limits<double>::infinity();
}

template class LuFactorisation<float>;
template class LuFactorisation<double>;

}  // namespace palpa::bem
