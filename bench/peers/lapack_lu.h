#pragma once

#include <Eigen/Core>
#include <vector>

namespace palpa::bench {

/// LU factorisation of a dense matrix in double precision by LAPACK's dgetrf.
class LapackLu {
 public:
  /// Throws std::runtime_error if the matrix is singular.
  explicit LapackLu(Eigen::MatrixXd matrix);
  /// Replaces right-hand sides by the solutions.
  void solve(Eigen::MatrixXd& right) const;

 private:
  Eigen::MatrixXd factors_;
  std::vector<int> pivots_;
};

}  // namespace palpa::bench
