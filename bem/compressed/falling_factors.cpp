#include "bem/compressed/falling_factors.h"

#include <cblas.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <vector>

namespace palpa::bem {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Summands below this are left out.
constexpr double kNothing = 0x1p-21;

/// A^T B
RowMatrixXf productOf(const RowMatrixXf& A, const RowMatrixXf& B) {
  RowMatrixXf product(A.cols(), B.cols());
  if (product.size() > 0)
    cblas_sgemm(CblasRowMajor, CblasTrans, CblasNoTrans, static_cast<int>(A.cols()),
                static_cast<int>(B.cols()), static_cast<int>(A.rows()), 1, A.data(),
                static_cast<int>(A.cols()), B.data(), static_cast<int>(B.cols()), 0, product.data(),
                static_cast<int>(product.cols()));
  return product;
}

}  // namespace

std::vector<PackedNumbers::Bits> bitsFor(const VectorXd& sizes, double error) {
  using Bits = PackedNumbers::Bits;
  std::vector<Bits> bits(static_cast<std::size_t>(sizes.size()));
  Bits needed = Bits::k8;
  for (Index k = sizes.size() - 1; k >= 0; --k) {
    if (sizes[k] > 0x1p15 * error)
      needed = Bits::k24;
    else if (sizes[k] > 0x1p7 * error)
      needed = std::max(needed, Bits::k16);
    bits[static_cast<std::size_t>(k)] = needed;
  }
  return bits;
}

FallingFactors fallingFactors(const RowMatrixXf& U, const RowMatrixXf& V, Index columnsOfV2,
                              float importance) {
  const Index rank = V.rows();
  if (rank == 0) return {};
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> weighted =
      V.cast<double>();
  weighted.rightCols(columnsOfV2) *= static_cast<double>(importance);
  MatrixXd gram = MatrixXd::Zero(rank, rank);
  cblas_dsyrk(CblasColMajor, CblasLower, CblasTrans, static_cast<int>(rank),
              static_cast<int>(weighted.cols()), 1, weighted.data(),
              static_cast<int>(weighted.cols()), 0, gram.data(), static_cast<int>(rank));
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(gram);
  if (solver.info() != Eigen::Success || !gram.allFinite()) {
    const std::vector<PackedNumbers::Bits> all(static_cast<std::size_t>(rank),
                                               PackedNumbers::Bits::k24);
    return {U, V, all, all};
  }
  const RowMatrixXf vectors = solver.eigenvectors().rowwise().reverse().cast<float>();
  const RowMatrixXf ofU = productOf(vectors, U), ofV = productOf(vectors, V);
  const VectorXd sizes = solver.eigenvalues().reverse().cwiseMax(0).cwiseSqrt().cwiseProduct(
      ofU.rowwise().norm().cast<double>());
  const double largest = sizes.maxCoeff();
  Index kept = rank;
  while (kept > 1 && sizes[kept - 1] < kNothing * largest) --kept;
  const VectorXd relative = sizes.head(kept) / (largest > 0 ? largest : 1);
  return {ofU.topRows(kept), ofV.topRows(kept), bitsFor(relative, kErrorOfU),
          bitsFor(relative, kErrorOfV)};
}

}  // namespace palpa::bem
