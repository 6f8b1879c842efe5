#include "bem/compressed/tile_lu.h"

#include <lapacke.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <string>

#include "base/parallel.h"
#include "bem/base/error.h"
#include "bem/linalg/blas_threads.h"
#include "bem/linalg/single_precision.h"

namespace palpa::bem {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;

namespace {

/// Random vectors that a basis begins with, those that are added while it does not suffice, and
/// those that test it.
constexpr int kSampleColumns = 32, kMoreColumns = 16, kTestColumns = 6;

}  // namespace

/// y = (base - Σ L U) x for a tile, or transposed.
void TileLu::sample(int row, int column, int before, const MatrixXf& base, const MatrixXf& x,
                    bool isTransposed, MatrixXf& y, const Job& job) const {
  multiply(isTransposed, false, 1, base, x, 0, y);
  MatrixXf a, b;
  // op(tile) in: out = X Y^T in, or Y X^T in.
  const auto apply = [&](const Tile& tile, const MatrixXf& in, float alpha, float beta,
                         MatrixXf& out) {
    if (tile.isDense()) {
      multiply(isTransposed, false, alpha, tile.X, in, beta, out);
      return;
    }
    multiply(true, false, 1, isTransposed ? tile.X : tile.Y, in, 0, a);
    multiply(false, false, alpha, isTransposed ? tile.Y : tile.X, a, beta, out);
  };
  for (int m = 0; m < before; ++m) {
    job.throwIfCancelled();
    const Tile &L = tile(row, m), &U = tile(m, column);
    if (L.rank() == 0 || U.rank() == 0) continue;
    apply(isTransposed ? L : U, x, 1, 0, b);
    apply(isTransposed ? U : L, b, -1, 1, y);
  }
}

MatrixXf TileLu::denseUpdate(int row, int column, int before, MatrixXf base, const Job& job) const {
  MatrixXf left, middle;
  for (int m = 0; m < before; ++m) {
    job.throwIfCancelled();
    const Tile &L = tile(row, m), &U = tile(m, column);
    if (L.rank() == 0 || U.rank() == 0) continue;
    if (L.isDense()) {
      multiply(false, false, 1, L.X, U.X, 0, left);
    } else {
      multiply(true, false, 1, L.Y, U.X, 0, middle);
      if (U.isDense()) {
        multiply(false, false, -1, L.X, middle, 1, base);
        continue;
      }
      multiply(false, false, 1, L.X, middle, 0, left);
    }
    if (U.isDense())
      base -= left;
    else
      multiply(false, true, -1, left, U.Y, 1, base);
  }
  return base;
}

TileLu::Tile TileLu::compress(int row, int column, int before, MatrixXf base,
                              const Job& job) const {
  const Index rows = base.rows(), columns = base.cols(), most = std::min(rows, columns) / 3;
  Tile result;
  MatrixXf basis(rows, 0), samples, projections;
  unsigned seed = 7919 * static_cast<unsigned>(row * count() + column);
  const auto sampleMore = [&](Index some) {
    sample(row, column, before, base, randomMatrix(columns, some, ++seed), false, samples, job);
  };
  const auto subtractBasis = [&] {
    if (basis.cols() == 0) return;
    multiply(true, false, 1, basis, samples, 0, projections);
    multiply(false, false, -1, basis, projections, 1, samples);
  };
  for (Index more = kSampleColumns;; more = kMoreColumns) {
    if (basis.cols() + more > most) {
      result.X = denseUpdate(row, column, before, std::move(base), job);
      return result;
    }
    sampleMore(more);
    subtractBasis();
    orthonormalise(samples);
    subtractBasis();  // orthogonal to rounding
    orthonormalise(samples);
    basis.conservativeResize(Eigen::NoChange, basis.cols() + more);
    basis.rightCols(more) = samples;
    sampleMore(kTestColumns);
    subtractBasis();
    if (samples.norm() < tolerance_ * std::sqrt(static_cast<float>(kTestColumns))) break;
  }
  MatrixXf onBasis;  // (columns, basis)
  sample(row, column, before, base, basis, true, onBasis, job);
  MatrixXf squares;
  multiply(true, false, 1, onBasis, onBasis, 0, squares);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(squares.cast<double>());
  // Singular values ascend.
  Index first = 0;
  double leftOut = 0;
  const double limit = static_cast<double>(tolerance_) * tolerance_;
  while (first < basis.cols() && leftOut + std::max(eigen.eigenvalues()[first], 0.0) < limit)
    leftOut += std::max(eigen.eigenvalues()[first++], 0.0);
  const MatrixXf turn = eigen.eigenvectors().rightCols(basis.cols() - first).cast<float>();
  multiply(false, false, 1, basis, turn, 0, result.X);
  multiply(false, false, 1, onBasis, turn, 0, result.Y);
  return result;
}

void TileLu::scaleColumns(int column, MatrixXf& tile) const {
  tile.array().rowwise() *= columnScales_.segment(begins_[column], sizes_[column]).transpose();
}

void TileLu::factorDiagonal(int k, const MakeTile& makeTile, const Job& job) {
  MatrixXf diagonal;
  makeTile(k, k, diagonal);
  scaleColumns(k, diagonal);
  // Parts of columns on several threads.
  constexpr Index kColumnsPerTask = 128;
  const Index columns = diagonal.cols();
  parallelFor((columns + kColumnsPerTask - 1) / kColumnsPerTask, job, [&](std::ptrdiff_t task) {
    const Index first = task * kColumnsPerTask, some = std::min(kColumnsPerTask, columns - first);
    MatrixXf part = diagonal.middleCols(first, some), a, b;
    for (int m = 0; m < k; ++m) {
      job.throwIfCancelled();
      const Tile &L = tile(k, m), &U = tile(m, k);
      if (L.rank() == 0 || U.rank() == 0) continue;
      if (U.isDense()) {
        b = U.X.middleCols(first, some);
      } else {
        const MatrixXf right = U.Y.middleRows(first, some);
        multiply(false, true, 1, U.X, right, 0, b);
      }
      if (L.isDense()) {
        multiply(false, false, -1, L.X, b, 1, part);
      } else {
        multiply(true, false, 1, L.Y, b, 0, a);
        multiply(false, false, -1, L.X, a, 1, part);
      }
    }
    diagonal.middleCols(first, some) = part;
  });
  pivots_[k].resize(static_cast<std::size_t>(columns));
  const auto n = static_cast<lapack_int>(columns);
  const lapack_int info =
      LAPACKE_sgetrf_work(LAPACK_COL_MAJOR, n, n, diagonal.data(), n, pivots_[k].data());
  if (info != 0)
    throw SolverError(SolverError::Kind::kSingular,
                      "the system of equations is singular near unknown " +
                          std::to_string(begins_[k] + info) + " of " + std::to_string(size()) +
                          "; check the supports and the mesh for degenerate places");
  tile(k, k).X = std::move(diagonal);
}

TileLu::TileLu(std::vector<int> sizes, float tolerance, const MakeTile& makeTile, const Job& job)
    : sizes_(std::move(sizes)), tolerance_(tolerance), pivots_(sizes_.size()) {
  useOneBlasThread();
  begins_.push_back(0);
  for (const int size : sizes_) begins_.push_back(begins_.back() + size);
  tiles_.resize(sizes_.size() * sizes_.size());
  columnScales_.resize(size());
  parallelFor(count(), job, [&](std::ptrdiff_t k) {
    MatrixXf diagonal;
    makeTile(static_cast<int>(k), static_cast<int>(k), diagonal);
    columnScales_.segment(begins_[k], sizes_[k]) =
        diagonal.colwise().norm().transpose().array().max(1e-30F).inverse();
  });
  std::vector<double> sums(static_cast<std::size_t>(size()), 0);
  std::mutex sumsMutex;
  const auto make = [&](int row, int column, MatrixXf& to) {
    makeTile(row, column, to);
    const Eigen::RowVectorXf magnitudes = to.cwiseAbs().colwise().sum();
    const std::scoped_lock lock(sumsMutex);
    for (Index c = 0; c < to.cols(); ++c) sums[begins_[column] + c] += magnitudes[c];
  };
  for (int k = 0; k < count(); ++k) {
    factorDiagonal(k, make, job);
    const int left = count() - k - 1;
    parallelFor(2 * static_cast<std::ptrdiff_t>(left), job, [&](std::ptrdiff_t task) {
      const int other = k + 1 + static_cast<int>(task / 2);
      const bool isOfL = task % 2 == 0;
      const int row = isOfL ? other : k, column = isOfL ? k : other;
      MatrixXf base;
      make(row, column, base);
      scaleColumns(column, base);
      Tile made = compress(row, column, k, std::move(base), job);
      const MatrixXf& diagonal = tile(k, k).X;
      if (isOfL) {  // L = A U^-1
        MatrixXf& right = made.isDense() ? made.X : made.Y;
        if (made.isDense())
          solveTriangular(CblasRight, CblasUpper, false, false, diagonal, right);
        else
          solveTriangular(CblasLeft, CblasUpper, true, false, diagonal, right);
      } else {  // U = L^-1 P A
        swapRows(pivots_[k], made.X, true);
        solveTriangular(CblasLeft, CblasLower, false, true, diagonal, made.X);
      }
      tile(row, column) = std::move(made);
    });
    const double rest = static_cast<double>(left) / count();
    job.report(Phase::kFactorise, 1 - rest * rest);
  }
  norm1_ = *std::max_element(sums.begin(), sums.end());
}

std::size_t TileLu::bytes() const {
  std::size_t bytes = 0;
  for (const Tile& each : tiles_)
    bytes += static_cast<std::size_t>(each.X.size() + each.Y.size()) * sizeof(float);
  return bytes;
}

int TileLu::largestRank() const {
  int largest = 0;
  for (int row = 0; row < count(); ++row)
    for (int column = 0; column < count(); ++column)
      if (row != column) largest = std::max(largest, tile(row, column).rank());
  return largest;
}

double TileLu::meanRank() const {
  double sum = 0;
  for (int row = 0; row < count(); ++row)
    for (int column = 0; column < count(); ++column)
      if (row != column) sum += tile(row, column).rank();
  return count() > 1 ? sum / (count() * (count() - 1.0)) : 0;
}

template <class Use>
void TileLu::forOthers(int first, int end, const Job& job, const Use& use) const {
  constexpr int kTilesPerTask = 4;
  parallelFor((end - first + kTilesPerTask - 1) / kTilesPerTask, job, [&](std::ptrdiff_t task) {
    const int from = first + kTilesPerTask * static_cast<int>(task);
    for (int k = from; k < std::min(end, from + kTilesPerTask); ++k) use(k);
  });
}

void TileLu::subtract(const Tile& tile, bool isTransposed, const MatrixXf& x, MatrixXf& y) {
  if (tile.rank() == 0) return;
  if (tile.isDense()) {
    multiply(isTransposed, false, -1, tile.X, x, 1, y);
    return;
  }
  MatrixXf inner;
  multiply(true, false, 1, isTransposed ? tile.X : tile.Y, x, 0, inner);
  multiply(false, false, -1, isTransposed ? tile.Y : tile.X, inner, 1, y);
}

std::vector<MatrixXf> TileLu::partsOf(const MatrixXf& x) const {
  std::vector<MatrixXf> parts;
  for (int k = 0; k < count(); ++k) parts.emplace_back(x.middleRows(begins_[k], sizes_[k]));
  return parts;
}

void TileLu::solveInPlace(MatrixXf& x, const Job& job) const {
  std::vector<MatrixXf> parts = partsOf(x);
  for (int k = 0; k < count(); ++k) {
    swapRows(pivots_[k], parts[k], true);
    solveTriangular(CblasLeft, CblasLower, false, true, tile(k, k).X, parts[k]);
    forOthers(k + 1, count(), job, [&](int i) { subtract(tile(i, k), false, parts[k], parts[i]); });
  }
  for (int k = count() - 1; k >= 0; --k) {
    solveTriangular(CblasLeft, CblasUpper, false, false, tile(k, k).X, parts[k]);
    forOthers(0, k, job, [&](int i) { subtract(tile(i, k), false, parts[k], parts[i]); });
  }
  for (int k = 0; k < count(); ++k) x.middleRows(begins_[k], sizes_[k]) = parts[k];
  x.array().colwise() *= columnScales_;
}

void TileLu::solveTransposedInPlace(MatrixXf& x, const Job& job) const {
  x.array().colwise() *= columnScales_;
  std::vector<MatrixXf> parts = partsOf(x);
  for (int k = 0; k < count(); ++k) {
    solveTriangular(CblasLeft, CblasUpper, true, false, tile(k, k).X, parts[k]);
    forOthers(k + 1, count(), job, [&](int j) { subtract(tile(k, j), true, parts[k], parts[j]); });
  }
  for (int k = count() - 1; k >= 0; --k) {
    solveTriangular(CblasLeft, CblasLower, true, true, tile(k, k).X, parts[k]);
    swapRows(pivots_[k], parts[k], false);
    forOthers(0, k, job, [&](int j) { subtract(tile(k, j), true, parts[k], parts[j]); });
  }
  for (int k = 0; k < count(); ++k) x.middleRows(begins_[k], sizes_[k]) = parts[k];
}

}  // namespace palpa::bem
