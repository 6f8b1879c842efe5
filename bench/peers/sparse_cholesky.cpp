#include "bench/peers/sparse_cholesky.h"

#include <cholmod.h>

#include <algorithm>
#include <stdexcept>

namespace palpa::bench {

using Eigen::MatrixXd;

struct SparseCholesky::State {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  // Of solves, reused from one to the next.
  cholmod_dense *result = nullptr, *y = nullptr, *e = nullptr;

  State() { cholmod_start(&common); }
  ~State() {
    for (cholmod_dense** each : {&result, &y, &e}) cholmod_free_dense(each, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }

  MatrixXd solve(int system, const MatrixXd& b) {
    cholmod_dense right{};
    right.nrow = right.d = static_cast<std::size_t>(b.rows());
    right.ncol = static_cast<std::size_t>(b.cols());
    right.nzmax = right.nrow * right.ncol;
    right.x = const_cast<double*>(b.data());  // CHOLMOD only reads it
    right.xtype = CHOLMOD_REAL;
    right.dtype = CHOLMOD_DOUBLE;
    if (!cholmod_solve2(system, factor, &right, nullptr, &result, nullptr, &y, &e, &common))
      throw std::runtime_error("CHOLMOD cannot solve");
    return Eigen::Map<const MatrixXd>(static_cast<const double*>(result->x), b.rows(), b.cols());
  }
};

SparseCholesky::SparseCholesky(const Eigen::SparseMatrix<double>& lower)
    : state_(std::make_unique<State>()) {
  cholmod_common& common = state_->common;
  common.supernodal = CHOLMOD_SUPERNODAL;
  common.final_ll = true;
  common.print = 0;
  common.nmethods = 2;
  common.method[0].ordering = CHOLMOD_AMD;
  common.method[1].ordering = CHOLMOD_METIS;
  cholmod_sparse matrix{};
  matrix.nrow = static_cast<std::size_t>(lower.rows());
  matrix.ncol = static_cast<std::size_t>(lower.cols());
  matrix.nzmax = static_cast<std::size_t>(lower.nonZeros());
  matrix.p = const_cast<int*>(lower.outerIndexPtr());  // CHOLMOD only reads these
  matrix.i = const_cast<int*>(lower.innerIndexPtr());
  matrix.x = const_cast<double*>(lower.valuePtr());
  matrix.stype = -1;
  matrix.itype = CHOLMOD_INT;
  matrix.xtype = CHOLMOD_REAL;
  matrix.dtype = CHOLMOD_DOUBLE;
  matrix.sorted = matrix.packed = true;
  state_->factor = cholmod_analyze(&matrix, &common);
  if (!state_->factor || !cholmod_factorize(&matrix, state_->factor, &common) ||
      common.status != CHOLMOD_OK)
    throw std::runtime_error(
        "CHOLMOD cannot factorise: the matrix is not positive definite, or "
        "too large");
}

SparseCholesky::~SparseCholesky() = default;

MatrixXd SparseCholesky::solve(const MatrixXd& b) {
  return state_->solve(CHOLMOD_A, b);
}

MatrixXd SparseCholesky::solveForward(const MatrixXd& b) {
  return state_->solve(CHOLMOD_L, state_->solve(CHOLMOD_P, b));
}

MatrixXd SparseCholesky::solveBackward(const MatrixXd& y) {
  return state_->solve(CHOLMOD_Pt, state_->solve(CHOLMOD_Lt, y));
}

const char* SparseCholesky::ordering() const {
  return state_->factor->ordering == CHOLMOD_METIS ? "METIS" : "AMD";
}

double SparseCholesky::entries() const {
  return state_->common.lnz;
}

}  // namespace palpa::bench
