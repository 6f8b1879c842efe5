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

/// Sums of the magnitudes in each column; of a narrow tile, whose neighbouring rows are similar,
/// from one row of 17, so that all three components count.
Eigen::VectorXd columnMagnitudes(const LowRankTile& tile) {
  if (tile.isDense()) return tile.X.cwiseAbs().colwise().sum().cast<double>();
  constexpr Index kStep = 17;
  const MatrixXf rows = tile.X(Eigen::seq(0, Eigen::last, kStep), Eigen::all);
  MatrixXf some;
  multiply(false, true, 1, rows, tile.Y, 0, some);
  return some.cwiseAbs().colwise().sum().cast<double>() *
         (static_cast<double>(tile.X.rows()) / static_cast<double>(rows.rows()));
}

}  // namespace

TileLu::PackedTile TileLu::packed(const LowRankTile& tile) const {
  // With 8 bits, numbers have errors of 2^-9 of the largest in their group on average: many small
  // summands together remain below the tolerance.
  constexpr float kSmall = 8;
  const Index rank = tile.X.cols();
  Index small = 0;  // singular values ascend
  if (!tile.isDense())
    while (small < rank &&
           tile.X.col(small).norm() * tile.Y.col(small).norm() < kSmall * tolerance_)
      ++small;
  const auto numbers = [](const MatrixXf& of, Index first, Index columns,
                          PackedNumbers::Bits bits) {
    return PackedNumbers(
        std::span(of.data() + first * of.rows(), static_cast<std::size_t>(columns * of.rows())),
        bits);
  };
  using Bits = PackedNumbers::Bits;
  return {static_cast<int>(rank),
          static_cast<int>(tile.Y.cols()),
          static_cast<int>(small),
          numbers(tile.X, 0, small, Bits::k8),
          numbers(tile.Y, 0, small, Bits::k8),
          numbers(tile.X, small, rank - small, Bits::k16),
          numbers(tile.Y, small, std::max<Index>(0, tile.Y.cols() - small), Bits::k16)};
}

void TileLu::unpack(int row, int column, LowRankTile& to) const {
  const PackedTile& from = tile(row, column);
  to.X.resize(sizes_[row], from.rank);
  to.Y.resize(from.rankOfY > 0 ? sizes_[column] : 0, from.rankOfY);
  from.smallX.unpackTo(to.X.data());
  from.smallY.unpackTo(to.Y.data());
  from.X.unpackTo(to.X.data() + from.smallX.size());
  from.Y.unpackTo(to.Y.data() + from.smallY.size());
}

LowRankTile TileLu::unpacked(int row, int column) const {
  LowRankTile tile;
  unpack(row, column, tile);
  return tile;
}

TileLu::Step TileLu::beginStep(int k, const Job& job) const {
  Step step;
  parallelFor(2, job, [&](std::ptrdiff_t side) {
    SharedFactors& shared = side == 0 ? step.ofColumn : step.ofRow;
    for (int m = 0; m < k; ++m) {
      job.throwIfCancelled();
      shared.factors.push_back(side == 0 ? unpacked(m, k) : unpacked(k, m));
      if (side == 1) transpose(shared.factors.back());
    }
    shared.draw(sizes_[k], 7919 * static_cast<unsigned>(2 * k + side));
  });
  return step;
}

void TileLu::scaleColumns(int column, LowRankTile& tile) const {
  const auto scales = columnScales_.segment(begins_[column], sizes_[column]);
  if (tile.isDense())
    tile.X.array().rowwise() *= scales.transpose();
  else
    tile.Y.array().colwise() *= scales;
}

MatrixXf TileLu::factorDiagonal(int k, const Step& step, LowRankTile base, const Job& job) {
  scaleColumns(k, base);
  MatrixXf diagonal = toDense(std::move(base));
  // Parts of columns on several threads.
  constexpr Index kColumnsPerTask = 128;
  const Index columns = diagonal.cols();
  parallelFor((columns + kColumnsPerTask - 1) / kColumnsPerTask, job, [&](std::ptrdiff_t task) {
    const Index first = task * kColumnsPerTask, some = std::min(kColumnsPerTask, columns - first);
    MatrixXf part = diagonal.middleCols(first, some), right, inner;
    for (int m = 0; m < k; ++m) {
      job.throwIfCancelled();
      const LowRankTile &U = step.ofColumn.factors[m], &L = step.ofRow.factors[m];
      if (U.isZero() || L.isZero()) continue;
      if (U.isDense())
        right = U.X.middleCols(first, some);
      else
        multiply(false, true, 1, U.X, U.Y.middleRows(first, some), 0, right);
      if (L.isDense()) {
        multiply(true, false, -1, L.X, right, 1, part);
      } else {  // L is transposed
        multiply(true, false, 1, L.X, right, 0, inner);
        multiply(false, false, -1, L.Y, inner, 1, part);
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
      const MatrixXf diagonal = toDense(bases.take(k, k));
      columnScales_.segment(begins_[k], sizes_[k]) =
          diagonal.colwise().norm().transpose().array().max(1e-30F).inverse();
    });
  }
  if (team) columnScales_ = sumOverTeam(*team, Eigen::VectorXf(columnScales_)).array();
}

LowRankTile TileLu::makeTile(int row, int column, const Step& step, LowRankTile base,
                             const MatrixXf& diagonal, const Job& job) const {
  scaleColumns(column, base);
  const bool isInColumn = row > column;  // the tiles of the row are made transposed
  if (!isInColumn) transpose(base);
  std::vector<LowRankTile> left;
  for (int m = 0; m < std::min(row, column); ++m) {
    left.push_back(isInColumn ? unpacked(row, m) : unpacked(m, column));
    if (!isInColumn) transpose(left.back());
  }
  LowRankTile made =
      TileDifference(std::move(base), std::move(left), isInColumn ? step.ofColumn : step.ofRow, job)
          .compress(tolerance_, 7919 * static_cast<unsigned>(row * count() + column));
  if (!isInColumn) transpose(made);
  if (isInColumn) {  // L = A U^-1
    MatrixXf& right = made.isDense() ? made.X : made.Y;
    if (made.isDense())
      solveTriangular(CblasRight, CblasUpper, false, false, diagonal, right);
    else
      solveTriangular(CblasLeft, CblasUpper, true, false, diagonal, right);
  } else {  // U = L^-1 P A
    swapRows(pivots_[row], made.X, true);
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
    LowRankTile base = bases.take(row, column);
    const Eigen::VectorXd magnitudes = columnMagnitudes(base);
    const std::scoped_lock lock(sumsMutex);
    // All members of a team have the diagonal, one counts it.
    if (row != column || bases.isOurs(row))
      sums.segment(begins_[column], sizes_[column]) += magnitudes;
    return base;
  };
  for (int k = 0; k < count(); ++k) {
    bases.collectStep(k, job);
    const Step step = beginStep(k, job);
    const MatrixXf diagonal = factorDiagonal(k, step, take(k, k), job);
    const int left = count() - k - 1;
    parallelFor(2 * static_cast<std::ptrdiff_t>(left), job, [&](std::ptrdiff_t task) {
      const int other = k + 1 + static_cast<int>(task / 2);
      if (!bases.isOurs(other)) return;
      const int row = task % 2 == 0 ? other : k, column = task % 2 == 0 ? k : other;
      tile(row, column) = packed(makeTile(row, column, step, take(row, column), diagonal, job));
    });
    if (team) shareStep(k, *team);
    const double rest = static_cast<double>(left) / count();
    job.report(Phase::kFactorise, 1 - rest * rest);
  }
  norm1_ = (team ? sumOverTeam(*team, sums) : sums).maxCoeff();
}

}  // namespace palpa::bem
