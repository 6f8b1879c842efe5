#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "bem/compressed/tile_lu.h"
#include "bem/linalg/single_precision.h"

namespace palpa::bem {

using Eigen::Index;
using Eigen::MatrixXf;

std::size_t TileLu::bytes() const {
  std::size_t bytes = 0;
  for (const PackedTile& each : tiles_) bytes += each.bytes();
  return bytes;
}

int TileLu::largestRank() const {
  int largest = 0;
  for (int row = 0; row < count(); ++row)
    for (int column = 0; column < count(); ++column)
      if (row != column) largest = std::max(largest, tile(row, column).rank);
  return largest;
}

double TileLu::meanRank() const {
  double sum = 0;
  for (int row = 0; row < count(); ++row)
    for (int column = 0; column < count(); ++column)
      if (row != column) sum += tile(row, column).rank;
  return count() > 1 ? sum / (count() * (count() - 1.0)) : 0;
}

template <class Use>
void TileLu::forOthers(int first, int end, int next, SolveMemory& memory, const Job& job,
                       const Use& use) const {
  if (first == end) return;
  constexpr int kTilesPerTask = 4;
  const int tasks = (end - first + kTilesPerTask - 1) / kTilesPerTask;
  parallelFor(1 + tasks, job, [&](std::ptrdiff_t task) {
    if (task == 0) {
      unpack(next, next, memory.next);
      return;
    }
    const int from = first + kTilesPerTask * (static_cast<int>(task) - 1);
    SolveScratch scratch = memory.pool.take();
    for (int k = from; k < std::min(end, from + kTilesPerTask); ++k) use(k, scratch);
    memory.pool.giveBack(std::move(scratch));
  });
  std::swap(memory.diagonal, memory.next);
}

void TileLu::subtract(int row, int column, bool isTransposed, const MatrixXf& x, MatrixXf& y,
                      SolveScratch& scratch) const {
  if (tile(row, column).rank == 0) return;
  unpack(row, column, scratch.tile);
  const MatrixXf &X = scratch.tile.X, &Y = scratch.tile.Y;
  if (scratch.tile.isDense()) {
    multiply(isTransposed, false, -1, X, x, 1, y);
    return;
  }
  multiply(true, false, 1, isTransposed ? X : Y, x, 0, scratch.inner);
  multiply(false, false, -1, isTransposed ? Y : X, scratch.inner, 1, y);
}

std::vector<MatrixXf> TileLu::partsOf(const MatrixXf& x) const {
  std::vector<MatrixXf> parts;
  for (int k = 0; k < count(); ++k) parts.emplace_back(x.middleRows(begins_[k], sizes_[k]));
  return parts;
}

void TileLu::solveInPlace(MatrixXf& x, const Job& job) const {
  std::vector<MatrixXf> parts = partsOf(x);
  SolveMemory memory;
  unpack(0, 0, memory.diagonal);
  for (int k = 0; k < count(); ++k) {
    swapRows(pivots_[k], parts[k], true);
    solveTriangular(CblasLeft, CblasLower, false, true, memory.diagonal.X, parts[k]);
    forOthers(k + 1, count(), k + 1, memory, job, [&](int i, SolveScratch& scratch) {
      subtract(i, k, false, parts[k], parts[i], scratch);
    });
  }
  for (int k = count() - 1; k >= 0; --k) {
    solveTriangular(CblasLeft, CblasUpper, false, false, memory.diagonal.X, parts[k]);
    forOthers(0, k, k - 1, memory, job, [&](int i, SolveScratch& scratch) {
      subtract(i, k, false, parts[k], parts[i], scratch);
    });
  }
  for (int k = 0; k < count(); ++k) x.middleRows(begins_[k], sizes_[k]) = parts[k];
  x.array().colwise() *= columnScales_;
}

void TileLu::solveTransposedInPlace(MatrixXf& x, const Job& job) const {
  x.array().colwise() *= columnScales_;
  std::vector<MatrixXf> parts = partsOf(x);
  SolveMemory memory;
  unpack(0, 0, memory.diagonal);
  for (int k = 0; k < count(); ++k) {
    solveTriangular(CblasLeft, CblasUpper, true, false, memory.diagonal.X, parts[k]);
    forOthers(k + 1, count(), k + 1, memory, job, [&](int j, SolveScratch& scratch) {
      subtract(k, j, true, parts[k], parts[j], scratch);
    });
  }
  for (int k = count() - 1; k >= 0; --k) {
    solveTriangular(CblasLeft, CblasLower, true, true, memory.diagonal.X, parts[k]);
    swapRows(pivots_[k], parts[k], false);
    forOthers(0, k, k - 1, memory, job, [&](int j, SolveScratch& scratch) {
      subtract(k, j, true, parts[k], parts[j], scratch);
    });
  }
  for (int k = 0; k < count(); ++k) x.middleRows(begins_[k], sizes_[k]) = parts[k];
}

}  // namespace palpa::bem
