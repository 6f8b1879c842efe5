#include "bem/lu_factorisation.h"

#include <cblas.h>
#include <lapacke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>

namespace palpa::bem {
namespace {

/// Columns per panel: wide enough for the speed of the matrix products, narrow enough that a stop
/// request waits no longer than one trailing update.
constexpr lapack_int kPanel = 192;

/// Work of one block of a trailing update, between two looks at the stop token: 20 ms at
/// 75 GFLOP/s.
constexpr double kBlockFlops = 1.5e9;

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
lapack_int getrs(char transposed, lapack_int n, lapack_int columns, const float* a,
                 const int* pivots, float* b) {
  return LAPACKE_sgetrs_work(LAPACK_COL_MAJOR, transposed, n, columns, a, n, pivots, b, n);
}
lapack_int getrs(char transposed, lapack_int n, lapack_int columns, const double* a,
                 const int* pivots, double* b) {
  return LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, transposed, n, columns, a, n, pivots, b, n);
}
void lacn2(lapack_int n, float* v, float* x, lapack_int* signs, float* estimate, lapack_int* next,
           lapack_int* saved) {
  LAPACKE_slacn2(n, v, x, signs, estimate, next, saved);
}
void lacn2(lapack_int n, double* v, double* x, lapack_int* signs, double* estimate,
           lapack_int* next, lapack_int* saved) {
  LAPACKE_dlacn2(n, v, x, signs, estimate, next, saved);
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
    const auto most = static_cast<lapack_int>(kBlockFlops / (2.0 * width * std::max(n - end, 1)));
    for (lapack_int left = end; left < n;) {
      job.throwIfCancelled();
      const lapack_int columns = std::min(std::max(most, kPanel), n - left);
      laswp(columns, at(0, left), n, first + 1, end, pivots_.data());
      solveUnitLower(width, columns, at(first, first), n, at(first, left));
      subtractProduct(n - end, columns, width, at(end, first), at(first, left), at(end, left), n);
      left += columns;
    }
    job.report("factorise", 1.0 - std::pow(1.0 - static_cast<double>(end) / n, 3));
  }
}

template <class Scalar>
void LuFactorisation<Scalar>::solveInPlace(
    Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& rightHandSides) const {
  getrs('N', static_cast<lapack_int>(size()), static_cast<lapack_int>(rightHandSides.cols()),
        matrix_.data(), pivots_.data(), rightHandSides.data());
}

template <class Scalar>
double LuFactorisation<Scalar>::conditionEstimate(const Job& job) const {
  const auto n = static_cast<lapack_int>(size());
  // On page borders: the library adds up magnitudes in an order that depends on where a vector
  // lies.
  LargeMatrix<Scalar> v(n, 1), x(n, 1);
  std::vector<lapack_int> signs(size());
  std::array<lapack_int, 3> saved{};
  Scalar inverseNorm = 0;
  lapack_int next = 0;
  for (;;) {
    lacn2(n, v.data(), x.data(), signs.data(), &inverseNorm, &next, saved.data());
    if (next == 0) break;
    job.throwIfCancelled();
    getrs(next == 1 ? 'N' : 'T', n, 1, matrix_.data(), pivots_.data(), x.data());
  }
  const double estimate = static_cast<double>(inverseNorm) * norm1_;
  return std::isfinite(estimate) ? estimate : std::numeric_limits<double>::infinity();
}

template <class Scalar>
void LuFactorisation<Scalar>::write(const ByteSink& sink) const {
  sink(std::as_bytes(std::span(matrix_.data(), matrix_.bytes() / sizeof(Scalar))));
  sink(std::as_bytes(std::span(pivots_)));
  sink(std::as_bytes(std::span(&norm1_, 1)));
}

template <class Scalar>
LuFactorisation<Scalar>::LuFactorisation(Eigen::Index size, const ByteSource& source)
    : matrix_(size, size), pivots_(size) {
  source(std::as_writable_bytes(std::span(matrix_.data(), matrix_.bytes() / sizeof(Scalar))));
  source(std::as_writable_bytes(std::span(pivots_)));
  source(std::as_writable_bytes(std::span(&norm1_, 1)));
}

template class LuFactorisation<float>;
template class LuFactorisation<double>;

}  // namespace palpa::bem
