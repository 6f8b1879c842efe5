#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace palpa::bench {

/// Supernodal Cholesky factorisation P A P^T = L L^T of a sparse matrix by CHOLMOD (Chen, Davis,
/// Hager & Rajamanickam, ACM TOMS 35, 2008), on all cores through BLAS. Orderings: AMD and METIS,
/// whichever fills less. Not thread-safe.
class SparseCholesky {
 public:
  /// `lower`: the lower triangle of A. Throws std::runtime_error unless A is positive definite.
  explicit SparseCholesky(const Eigen::SparseMatrix<double>& lower);
  ~SparseCholesky();
  SparseCholesky(const SparseCholesky&) = delete;
  SparseCholesky& operator=(const SparseCholesky&) = delete;

  /// A^-1 b.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b);
  /// Its first half, y = L^-1 P b: b^T A^-1 b = y^T y.
  Eigen::MatrixXd solveForward(const Eigen::MatrixXd& b);
  /// Its second half, P^T L^-T y.
  Eigen::MatrixXd solveBackward(const Eigen::MatrixXd& y);

  const char* ordering() const;  ///< the chosen one: "AMD" or "METIS"
  double entries() const;        ///< of L

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace palpa::bench
