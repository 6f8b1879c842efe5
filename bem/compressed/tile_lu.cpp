#include "bem/compressed/tile_lu.h"

#include <lapacke.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <string>

#include "base/parallel.h"
#include "bem/base/error.h"
#include "bem/base/team_data.h"
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

TileLu::PackedTile TileLu::packed(const Tile& tile) {
  return {static_cast<int>(tile.X.cols()), static_cast<int>(tile.Y.cols()), PackedNumbers(tile.X),
          PackedNumbers(tile.Y)};
}

void TileLu::unpack(int row, int column, Tile& to) const {
  const PackedTile& from = tile(row, column);
  to.X.resize(sizes_[row], from.rank);
  to.Y.resize(from.rankOfY > 0 ? sizes_[column] : 0, from.rankOfY);
  from.X.unpackTo(to.X.data());
  from.Y.unpackTo(to.Y.data());
}

bool TileLu::unpackPair(int row, int m, int column, Tile& L, Tile& U) const {
  if (tile(row, m).rank == 0 || tile(m, column).rank == 0) return false;
  unpack(row, m, L);
  unpack(m, column, U);
  return true;
}

/// y = (base - Σ L U) x for a tile, or transposed.
void TileLu::sample(int row, int column, int before, const MatrixXf& base, const MatrixXf& x,
                    bool isTransposed, MatrixXf& y, const Job& job) const {
  multiply(isTransposed, false, 1, base, x, 0, y);
  MatrixXf a, b;
  Tile L, U;
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
    if (!unpackPair(row, m, column, L, U)) continue;
    apply(isTransposed ? L : U, x, 1, 0, b);
    apply(isTransposed ? U : L, b, -1, 1, y);
  }
}

MatrixXf TileLu::denseUpdate(int row, int column, int before, MatrixXf base, const Job& job) const {
  MatrixXf left, middle;
  Tile L, U;
  for (int m = 0; m < before; ++m) {
    job.throwIfCancelled();
    if (!unpackPair(row, m, column, L, U)) continue;
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

MatrixXf TileLu::factorDiagonal(int k, MatrixXf diagonal, const Job& job) {
  scaleColumns(k, diagonal);
  // Parts of columns on several threads.
  constexpr Index kColumnsPerTask = 128;
  const Index columns = diagonal.cols();
  parallelFor((columns + kColumnsPerTask - 1) / kColumnsPerTask, job, [&](std::ptrdiff_t task) {
    const Index first = task * kColumnsPerTask, some = std::min(kColumnsPerTask, columns - first);
    MatrixXf part = diagonal.middleCols(first, some), a, b;
    Tile L, U;
    for (int m = 0; m < k; ++m) {
      job.throwIfCancelled();
      if (!unpackPair(k, m, k, L, U)) continue;
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
  tile(k, k) = packed({diagonal, {}});
  return diagonal;
}

void TileLu::setColumnScales(TileBases& bases, const Team* team, const Job& job) {
  columnScales_.setZero(size());
  const int atOnce = team ? 8 * team->count() : count();
  for (int first = 0; first < count(); first += atOnce) {
    const int end = std::min(count(), first + atOnce);
    std::vector<TileBases::Place> places;
    for (int k = first; k < end; ++k) places.push_back({k, k, team ? k % team->count() : 0});
    bases.collect(places, job);
    parallelFor(end - first, job, [&](std::ptrdiff_t task) {
      const int k = first + static_cast<int>(task);
      if (!bases.isOurs(k)) return;
      MatrixXf diagonal;
      bases.take(k, k, diagonal);
      columnScales_.segment(begins_[k], sizes_[k]) =
          diagonal.colwise().norm().transpose().array().max(1e-30F).inverse();
    });
  }
  if (team) columnScales_ = sumOverTeam(*team, Eigen::VectorXf(columnScales_)).array();
}

TileLu::Tile TileLu::makeTile(int row, int column, MatrixXf base, const MatrixXf& diagonal,
                              const Job& job) const {
  const int k = std::min(row, column);
  scaleColumns(column, base);
  Tile made = compress(row, column, k, std::move(base), job);
  if (row > column) {  // L = A U^-1
    MatrixXf& right = made.isDense() ? made.X : made.Y;
    if (made.isDense())
      solveTriangular(CblasRight, CblasUpper, false, false, diagonal, right);
    else
      solveTriangular(CblasLeft, CblasUpper, true, false, diagonal, right);
  } else {  // U = L^-1 P A
    swapRows(pivots_[k], made.X, true);
    solveTriangular(CblasLeft, CblasLower, false, true, diagonal, made.X);
  }
  return made;
}

TileLu::TileLu(std::vector<int> sizes, float tolerance, const MakeTile& makeBase, const Job& job,
               const Team* team)
    : sizes_(std::move(sizes)), tolerance_(tolerance), pivots_(sizes_.size()) {
  useOneBlasThread();
  begins_.push_back(0);
  for (const int size : sizes_) begins_.push_back(begins_.back() + size);
  tiles_.resize(sizes_.size() * sizes_.size());
  TileBases bases(sizes_, makeBase, team);
  setColumnScales(bases, team, job);
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(size());
  std::mutex sumsMutex;
  const auto take = [&](int row, int column) {
    MatrixXf base;
    bases.take(row, column, base);
    const Eigen::VectorXd magnitudes = base.cwiseAbs().colwise().sum().cast<double>();
    const std::scoped_lock lock(sumsMutex);
    // All members of a team have the diagonal, one counts it.
    if (row != column || bases.isOurs(row))
      sums.segment(begins_[column], base.cols()) += magnitudes;
    return base;
  };
  for (int k = 0; k < count(); ++k) {
    bases.collectStep(k, job);
    const MatrixXf diagonal = factorDiagonal(k, take(k, k), job);
    const int left = count() - k - 1;
    parallelFor(2 * static_cast<std::ptrdiff_t>(left), job, [&](std::ptrdiff_t task) {
      const int other = k + 1 + static_cast<int>(task / 2);
      if (!bases.isOurs(other)) return;
      const int row = task % 2 == 0 ? other : k, column = task % 2 == 0 ? k : other;
      tile(row, column) = packed(makeTile(row, column, take(row, column), diagonal, job));
    });
    if (team) shareStep(k, *team);
    const double rest = static_cast<double>(left) / count();
    job.report(Phase::kFactorise, 1 - rest * rest);
  }
  norm1_ = (team ? sumOverTeam(*team, sums) : sums).maxCoeff();
}

}  // namespace palpa::bem
