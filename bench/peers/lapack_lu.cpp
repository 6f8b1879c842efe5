#include "bench/peers/lapack_lu.h"

#include <lapacke.h>

#include <stdexcept>

namespace palpa::bench {

LapackLu::LapackLu(Eigen::MatrixXd matrix)
    : factors_(std::move(matrix)), pivots_(static_cast<std::size_t>(factors_.rows())) {
  const auto n = static_cast<lapack_int>(factors_.rows());
  if (LAPACKE_dgetrf(LAPACK_COL_MAJOR, n, n, factors_.data(), n, pivots_.data()) != 0)
    throw std::runtime_error("the matrix is singular");
}

void LapackLu::solve(Eigen::MatrixXd& right) const {
  const auto n = static_cast<lapack_int>(factors_.rows());
  LAPACKE_dgetrs(LAPACK_COL_MAJOR, 'N', n, static_cast<lapack_int>(right.cols()), factors_.data(),
                 n, pivots_.data(), right.data(), n);
}

}  // namespace palpa::bench
