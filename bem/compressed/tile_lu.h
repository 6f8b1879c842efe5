#pragma once

#include <Eigen/Dense>
#include <functional>
#include <vector>

#include "base/byte_stream.h"
#include "base/job.h"
#include "base/scratch_pool.h"
#include "bem/base/team.h"
#include "bem/compressed/tile_bases.h"
#include "bem/compressed/tile_difference.h"
#include "bem/linalg/packed_numbers.h"

namespace palpa::bem {

/// Approximate LU factorisation of a square matrix in tiles: those on the diagonal are dense, the
/// others products of two narrow matrices where that is shorter (block low-rank; Amestoy et al.
/// 2015). What the former rows and columns subtract from a tile is not formed (TileDifference).
/// Rows are exchanged within tiles of the diagonal only. In single precision, stored as
/// PackedNumbers; a preconditioner.
///
/// Immutable; const use from several threads is safe.
class TileLu {
 public:
  /// Makes tile (row, column) of the matrix, with the given sizes; several threads.
  using MakeTile = TileBases::MakeTile;

  /// `sizes`: rows of each tile. `tolerance`: of the singular values that are left out, over the
  /// norm of the columns in their tile of the diagonal. Throws SolverError (kSingular), Cancelled.
  /// `team`: each member's tiles are summands of the matrix (an empty one is zero); the members
  /// share the work, and all get the factors.
  TileLu(std::vector<int> sizes, float tolerance, const MakeTile& makeBase, const Job& job,
         const Team* team = nullptr);
  /// Reads what write() wrote for a matrix with `size` rows. Throws DamagedData, and what the
  /// source throws.
  TileLu(Eigen::Index size, const ByteSource& source);
  /// Writes the factors bit by bit, in the byte order of this machine.
  void write(const ByteSink& sink) const;

  Eigen::Index size() const { return begins_.back(); }
  std::size_t bytes() const;
  /// Largest sum of magnitudes in a column of the matrix.
  double norm1() const { return norm1_; }
  /// Largest rank of a tile off the diagonal, for reports.
  int largestRank() const;
  double meanRank() const;

  /// Overwrites columns with the solutions. Throws Cancelled.
  void solveInPlace(Eigen::MatrixXf& x, const Job& job) const;
  /// The same with the transposed matrix.
  void solveTransposedInPlace(Eigen::MatrixXf& x, const Job& job) const;

 private:
  /// A LowRankTile with less than half of the memory. Summands of a product that hardly exceed the
  /// tolerance come first and have 8 bits, the others 16.
  struct PackedTile {
    int rank = 0, rankOfY = 0, smallSummands = 0;  ///< columns of X and Y
    PackedNumbers smallX, smallY, X, Y;
    std::size_t bytes() const { return smallX.bytes() + smallY.bytes() + X.bytes() + Y.bytes(); }
  };

  int count() const { return static_cast<int>(sizes_.size()); }
  PackedTile& tile(int row, int column) { return tiles_[row * sizes_.size() + column]; }
  const PackedTile& tile(int row, int column) const { return tiles_[row * sizes_.size() + column]; }
  PackedTile packed(const LowRankTile& tile) const;
  /// `to`: also gives the memory.
  void unpack(int row, int column, LowRankTile& to) const;
  LowRankTile unpacked(int row, int column) const;
  void setColumnScales(TileBases& bases, const Team* team, const Job& job);
  /// The former factors of step k: U(m, k), and L(k, m) transposed.
  struct Step {
    SharedFactors ofColumn, ofRow;
  };
  Step beginStep(int k, const Job& job) const;
  /// Sets and returns the factors of tile (k, k), in one matrix.
  Eigen::MatrixXf factorDiagonal(int k, const Step& step, LowRankTile base, const Job& job);
  /// Factor of a tile off the diagonal, of which the former ones are complete.
  LowRankTile makeTile(int row, int column, const Step& step, LowRankTile base,
                       const Eigen::MatrixXf& diagonal, const Job& job) const;
  /// Gives the tiles of step k to all members.
  void shareStep(int k, const Team& team);
  void writeTile(int row, int column, const ByteSink& sink) const;
  void readTile(int row, int column, const ByteSource& source);

  void scaleColumns(int column, LowRankTile& tile) const;
  /// Memory of a thread in a solution.
  struct SolveScratch {
    LowRankTile tile;
    Eigen::MatrixXf inner;
  };
  struct SolveMemory {
    LowRankTile diagonal, next;  ///< the tiles on the diagonal of a step and of the next one
    ScratchPool<SolveScratch> pool{[] { return SolveScratch{}; }};
  };
  /// Uses tiles `first`, …, `end` - 1; meanwhile another thread unpacks tile (next, next), which
  /// becomes `memory.diagonal` at the end. Nothing if there are no tiles.
  template <class Use>
  void forOthers(int first, int end, int next, SolveMemory& memory, const Job& job,
                 const Use& use) const;
  void subtract(int row, int column, bool isTransposed, const Eigen::MatrixXf& x,
                Eigen::MatrixXf& y, SolveScratch& scratch) const;
  std::vector<Eigen::MatrixXf> partsOf(const Eigen::MatrixXf& x) const;

  std::vector<int> sizes_;
  std::vector<Eigen::Index> begins_;
  float tolerance_;
  std::vector<PackedTile> tiles_;
  std::vector<std::vector<int>> pivots_;
  Eigen::ArrayXf columnScales_;  ///< the factors are of the matrix with these times its columns
  double norm1_ = 0;
};

}  // namespace palpa::bem
