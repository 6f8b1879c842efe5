#include "bem/linalg/lu_factorisation.h"

#include <cblas.h>
#include <lapacke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <span>
#include <string>

#include "base/parallel.h"
#include "bem/base/error.h"
#include "bem/linalg/blas_threads.h"

namespace palpa::bem {
namespace {

/// Columns per block. Narrow blocks distribute small matrices evenly; wide ones make matrix
/// products fast. No update of a block takes longer than 20 ms up to 40,000 unknowns.
Eigen::Index blockWidth(Eigen::Index n) {
  return n <= 600 ? 48 : n <= 1500 ? 96 : n <= 4000 ? 128 : 192;
}

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

/// Factorisation by blocks of columns on several threads. Updates of blocks by a panel of factors
/// are handed out one by one, in the order of the panels; the thread that has updated the next
/// panel factors it while the others continue. Each block sees the same operations on any number of
/// threads.
template <class Scalar>
class BlockedLu {
 public:
  BlockedLu(LargeMatrix<Scalar>& matrix, std::vector<int>& pivots, const Job& job)
      : a_(matrix.data()),
        n_(matrix.rows()),
        width_(blockWidth(n_)),
        blocks_((n_ + width_ - 1) / width_),
        pivots_(pivots),
        job_(job),
        updates_(blocks_, 0) {}

  void run() {
    factorPanel(0);
    reportFactored(0);
    // Panel k updates the blocks k + 1 … blocks - 1.
    const std::ptrdiff_t workers = std::min<std::ptrdiff_t>(workerCount(job_), blocks_);
    parallelFor(workers, job_, [&](std::ptrdiff_t) { work(); });
    parallelFor(blocks_ - 1, job_,
                [&](std::ptrdiff_t block) { swapRows(block, (block + 1) * width_, n_); });
  }

 private:
  Scalar* at(Eigen::Index row, Eigen::Index column) { return a_ + column * n_ + row; }
  Eigen::Index endOf(Eigen::Index block) const { return std::min(n_, (block + 1) * width_); }

  void work() {
    Eigen::Index panel = 0, block = 0;
    try {
      while (next(panel, block)) {
        update(panel, block);
        if (block == panel + 1) factorPanel(block);
        const std::scoped_lock lock(mutex_);
        updates_[block] = panel + 1;
        if (block == panel + 1) reportFactored(block);
        changed_.notify_all();
      }
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      isStopped_ = true;
      changed_.notify_all();
      throw;
    }
  }

  void reportFactored(Eigen::Index block) const {
    const double left = 1.0 - static_cast<double>(endOf(block)) / static_cast<double>(n_);
    job_.report(Phase::kFactorise, 1.0 - left * left * left);
  }

  /// Waits for the next update that can run; false if there is none left.
  bool next(Eigen::Index& panel, Eigen::Index& block) {
    std::unique_lock lock(mutex_);
    if (nextBlock_ == blocks_) nextBlock_ = ++nextPanel_ + 1;
    if (nextBlock_ >= blocks_) return false;
    panel = nextPanel_;
    block = nextBlock_++;
    // A panel is factored before the update of its block counts as done. Every update that a thread
    // waits for was handed out earlier, so another thread works on it.
    changed_.wait(
        lock, [&] { return isStopped_ || (updates_[panel] == panel && updates_[block] == panel); });
    return !isStopped_;
  }

  void factorPanel(Eigen::Index block) {
    job_.throwIfCancelled();
    const Eigen::Index first = block * width_;
    const auto width = static_cast<lapack_int>(endOf(block) - first);
    const lapack_int info = getrf(static_cast<lapack_int>(n_ - first), width, at(first, first),
                                  static_cast<lapack_int>(n_), &pivots_[first]);
    if (info != 0)
      throw SolverError(SolverError::Kind::kSingular,
                        "the system of equations is singular at unknown " +
                            std::to_string(first + info) + " of " + std::to_string(n_) +
                            "; check the supports and the mesh for degenerate places");
    for (Eigen::Index k = first; k < first + width; ++k) pivots_[k] += static_cast<int>(first);
  }

  void swapRows(Eigen::Index block, Eigen::Index first, Eigen::Index end) {
    const Eigen::Index column = block * width_;
    laswp(static_cast<lapack_int>(endOf(block) - column), at(0, column),
          static_cast<lapack_int>(n_), static_cast<lapack_int>(first + 1),
          static_cast<lapack_int>(end), pivots_.data());
  }

  void update(Eigen::Index panel, Eigen::Index block) {
    job_.throwIfCancelled();
    const Eigen::Index first = panel * width_, end = endOf(panel), column = block * width_;
    const auto n = static_cast<int>(n_), width = static_cast<int>(end - first),
               columns = static_cast<int>(endOf(block) - column);
    swapRows(block, first, end);
    solveUnitLower(width, columns, at(first, first), n, at(first, column));
    subtractProduct(n - static_cast<int>(end), columns, width, at(end, first), at(first, column),
                    at(end, column), n);
  }

  Scalar* const a_;
  const Eigen::Index n_, width_, blocks_;
  std::vector<int>& pivots_;
  const Job& job_;

  std::mutex mutex_;  // guards the members below and the progress callback
  std::condition_variable changed_;
  Eigen::Index nextPanel_ = 0, nextBlock_ = 1;
  std::vector<Eigen::Index> updates_;  ///< per block: panels that have updated it
  bool isStopped_ = false;
};

}  // namespace

template <class Scalar>
LuFactorisation<Scalar>::LuFactorisation(LargeMatrix<Scalar> matrix, const Job& job)
    : matrix_(std::move(matrix)), pivots_(matrix_.rows()) {
  useOneBlasThread();
  norm1_ = matrix_.view().cwiseAbs().colwise().sum().maxCoeff();
  if (size() > 0) BlockedLu<Scalar>(matrix_, pivots_, job).run();
}

template <class Scalar>
void LuFactorisation<Scalar>::solveInPlace(
    Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& rightHandSides, const Job& job) const {
  // OpenBLAS solves for one column three times as fast as for two, and for 96 columns together
  // twice as fast as in parts of 24. At least two tasks; the same tasks on any number of threads.
  const Eigen::Index columns = rightHandSides.cols(),
                     perTask =
                         columns <= 6 ? 1 : std::clamp<Eigen::Index>((columns + 1) / 2, 8, 96);
  parallelFor((columns + perTask - 1) / perTask, job, [&](std::ptrdiff_t k) {
    const Eigen::Index first = k * perTask;
    getrs('N', static_cast<lapack_int>(size()),
          static_cast<lapack_int>(std::min(perTask, columns - first)), matrix_.data(),
          pivots_.data(), rightHandSides.col(first).data());
  });
}

template <class Scalar>
void LuFactorisation<Scalar>::solveTransposedInPlace(
    Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& rightHandSides) const {
  getrs('T', static_cast<lapack_int>(size()), static_cast<lapack_int>(rightHandSides.cols()),
        matrix_.data(), pivots_.data(), rightHandSides.data());
}

template <class Scalar>
double LuFactorisation<Scalar>::conditionEstimate(const Job& job) const {
  const auto n = static_cast<lapack_int>(size());
  // Aligned to pages: the order in which OpenBLAS sums magnitudes depends on the address.
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
  useOneBlasThread();
  source(std::as_writable_bytes(std::span(matrix_.data(), matrix_.bytes() / sizeof(Scalar))));
  source(std::as_writable_bytes(std::span(pivots_)));
  source(std::as_writable_bytes(std::span(&norm1_, 1)));
}

template class LuFactorisation<float>;
template class LuFactorisation<double>;

}  // namespace palpa::bem
