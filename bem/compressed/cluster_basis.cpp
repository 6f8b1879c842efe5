#include "bem/compressed/cluster_basis.h"

#include <cblas.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "bem/compressed/falling_factors.h"
#include "bem/linalg/single_precision.h"

namespace palpa::bem {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;
using Eigen::VectorXd;

namespace {

/// Random combinations of rows that a basis is looked for in; more while they do not suffice.
constexpr Index kCombinations = 160;
/// Combinations beyond the size of the basis that show that they suffice.
constexpr Index kSpare = 8;
/// A basis takes products with blocks apart, and pays only if it takes less than this share of the
/// memory.
constexpr double kWorthwhile = 0.85;

double bytesOf(std::span<const PackedNumbers::Bits> bits, Index columns) {
  double sum = 0;
  for (const PackedNumbers::Bits each : bits)
    sum += each == PackedNumbers::Bits::k24 ? 3 : each == PackedNumbers::Bits::k16 ? 2 : 1;
  return sum * static_cast<double>(columns);
}

/// Directions of the common basis, by falling size: (columns, size), orthonormal.
struct Directions {
  MatrixXf vectors;
  VectorXd sizes;  ///< relative to the largest
};

/// The directions of the rows of A, transposed, whose size is above `error`. `A`: (columns, rows).
Directions directionsOf(const MatrixXf& A, double error, unsigned seed) {
  for (Index combinations = kCombinations;; combinations *= 2) {
    const bool isAll = combinations >= A.cols();
    MatrixXf some;
    if (isAll)
      some = A;
    else
      multiply(false, false, 1, A, randomMatrix(A.cols(), combinations, seed), 0, some);
    const MatrixXd exact = some.cast<double>();
    MatrixXd squares = MatrixXd::Zero(some.cols(), some.cols());
    cblas_dsyrk(CblasColMajor, CblasLower, CblasTrans, static_cast<int>(some.cols()),
                static_cast<int>(some.rows()), 1, exact.data(), static_cast<int>(some.rows()), 0,
                squares.data(), static_cast<int>(some.cols()));
    if (!squares.allFinite()) return {};
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(squares);
    if (solver.info() != Eigen::Success) return {};
    const VectorXd sizes = solver.eigenvalues().reverse().cwiseMax(0).cwiseSqrt();
    const Index most = std::min(A.rows(), A.cols());
    Index size = 0;
    while (size < std::min(most, sizes.size()) && sizes[size] > error * sizes[0]) ++size;
    if (!isAll && size + kSpare > combinations && size < most) continue;
    Directions directions;
    directions.sizes = sizes.head(size) / (sizes[0] > 0 ? sizes[0] : 1);
    multiply(false, false, 1, some,
             solver.eigenvectors().rowwise().reverse().leftCols(size).cast<float>(), 0,
             directions.vectors);
    // Small directions are noise of the large ones otherwise.
    if (size > 0) orthonormalise(directions.vectors);
    return directions;
  }
}

}  // namespace

std::optional<CombinedFactors> combineFactors(std::span<const RightFactor* const> factors,
                                              Index columnsOfSlots, float importance,
                                              unsigned seed) {
  Index rows = 0;
  double before = 0;
  for (const RightFactor* factor : factors) {
    rows += factor->V.rows();
    before += bytesOf(factor->bits, factor->V.cols());
  }
  if (rows == 0) return std::nullopt;
  const Index columns = factors.front()->V.cols();
  if (columns <= kCombinations) return std::nullopt;  // a basis would be as large
  // By columns: each row of V is one, relative to the largest of its block.
  MatrixXf all(columns, rows);
  Index at = 0;
  for (const RightFactor* factor : factors) {
    auto part = all.middleCols(at, factor->V.rows());
    part = factor->V.transpose();
    part.bottomRows(columnsOfSlots) *= importance;
    const float largest = part.cols() > 0 ? part.colwise().norm().maxCoeff() : 0;
    if (largest > 0) part /= largest;
    at += factor->V.rows();
  }
  const Directions directions = directionsOf(all, kErrorOfV, seed);
  const Index size = directions.vectors.cols();
  if (size == 0) return std::nullopt;
  const std::vector<PackedNumbers::Bits> bits = bitsFor(directions.sizes, kErrorOfV);
  double after = bytesOf(bits, columns);
  for (const RightFactor* factor : factors) after += bytesOf(factor->bits, size);
  if (after > kWorthwhile * before) return std::nullopt;
  RowMatrixXf weighted = directions.vectors.transpose();
  weighted.rightCols(columnsOfSlots) *= importance;
  CombinedFactors result;
  for (const RightFactor* factor : factors) {
    RowMatrixXf coefficients = RowMatrixXf::Zero(factor->V.rows(), size);
    if (coefficients.size() > 0)
      cblas_sgemm(CblasRowMajor, CblasNoTrans, CblasTrans, static_cast<int>(factor->V.rows()),
                  static_cast<int>(size), static_cast<int>(columns), 1, factor->V.data(),
                  static_cast<int>(columns), weighted.data(), static_cast<int>(columns), 0,
                  coefficients.data(), static_cast<int>(size));
    result.coefficients.emplace_back(coefficients, factor->bits);
  }
  RowMatrixXf rowsOfBasis = directions.vectors.transpose();
  rowsOfBasis.rightCols(columnsOfSlots) /= importance;
  result.basis = {{rowsOfBasis.leftCols(columns - columnsOfSlots), bits},
                  {rowsOfBasis.rightCols(columnsOfSlots), bits}};
  return result;
}

}  // namespace palpa::bem
