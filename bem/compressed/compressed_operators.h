#pragma once

#include <span>
#include <vector>

#include "base/byte_stream.h"
#include "base/job.h"
#include "bem/base/team.h"
#include "bem/compressed/averaged_blocks.h"
#include "bem/compressed/block_rows.h"
#include "bem/compressed/compressed_order.h"
#include "bem/compressed/far_blocks.h"
#include "bem/element/element_equations.h"
#include "bem/element/element_quadrature.h"
#include "bem/model/boundary_mesh.h"
#include "bem/model/material.h"

namespace palpa::bem {

class LoadedColumns;
struct RigidProducts;

/// Boundary operators K = [-H G] as K = W P + N + R. The rows of P belong to the points of
/// equations, and are compressed in blocks (a hierarchical matrix): a block of a cluster of points
/// and a distant cluster of functions is a product of two narrow matrices. W has the weights of the
/// points in the equations, N what averaged elements have near, R makes the products of
/// rigid motions exact.
///
/// Rows and columns are in the order of a CompressedOrder; block columns are node positions, then
/// slot positions behind them. Blocks are stored with 16 bits per number, products are computed in
/// single precision; immutable after assembly.
///
/// A member of a team has a share of the blocks, all others are zero: its functions give a summand
/// of what the whole gives.
class CompressedOperators {
 public:
  /// Reads what write() wrote. Throws DamagedData, and what the source throws.
  explicit CompressedOperators(const ByteSource& source);
  /// Writes everything bit by bit, in the byte order of this machine.
  void write(const ByteSink& sink) const;
  /// Adds the share of another member of the team that made this one.
  void add(CompressedOperators share);

  const CompressedOrder& order() const { return order_; }
  int equationCount() const { return static_cast<int>(weights_.rows()); }
  int nodeCount() const { return static_cast<int>(order_.tree.order().size()); }

  /// G p - H u of fields, with the rows of BoundaryOperators. Throws Cancelled.
  Eigen::MatrixXd apply(const Eigen::MatrixXd& u, const Eigen::MatrixXd& p, const Job& job) const;

  /// Keeps its memory, which is expensive to get, when its size changes.
  class ReusedMatrix {
   public:
    void setZero(Eigen::Index rows, Eigen::Index columns);
    Eigen::Map<RowMatrixXf> matrix() { return {numbers_.data(), rows_, columns_}; }

   private:
    std::vector<float> numbers_;
    Eigen::Index rows_ = 0, columns_ = 0;
  };
  /// Some rows and columns as the dense matrix `ofEquations`, [3 k + i][column]. `equations`: any;
  /// `columns`: ascending column numbers, 3 * (block column) + c, all of one cluster of the tree.
  struct Scratch {
    std::vector<int> places, points, placeOfPoint;
    ReusedMatrix ofPoints, ofEquations;
    RowMatrixXf left, right;       // U of some points and V of some columns
    std::vector<Eigen::Index> to;  // places of these columns in the result
    std::vector<int> from;         // their numbers in the block
    RowMatrixXf ofBasis;           // these columns of a basis
    std::vector<float> unpacked, unpackedCoefficients;
  };
  void expand(std::span<const int> equations, std::span<const int> columns, Scratch& scratch) const;
  /// The same without N, R and the corrections of P, as a product of narrow matrices, left right^T.
  /// False if a dense block reaches there or the rank would be above `maxRank`, or zero.
  bool expandNarrow(std::span<const int> equations, std::span<const int> columns,
                    Eigen::Index maxRank, Scratch& scratch, Eigen::MatrixXf& left,
                    Eigen::MatrixXf& right) const;
  /// Appends the block columns that N, R and the corrections of P have for some equations.
  void appendSparseColumns(std::span<const int> equations, std::vector<int>& to) const;
  /// False if the blocks of these equations are all zero, because other members have them.
  bool reaches(std::span<const int> equations) const;

  std::size_t bytes() const;
  /// Sizes for reports: bytes of the low-rank blocks, the dense blocks and N; mean rank.
  struct Sizes {
    std::size_t far = 0, near = 0, averaged = 0;
    int farBlocks = 0, bases = 0;
    double meanRank = 0;
  };
  Sizes sizes() const;

 private:
  friend class CompressedAssembly;
  CompressedOperators() = default;
  struct NearBlock {
    int column;
    PackedNumbers K;  ///< (rows, columns), by columns
  };
  /// P x for x in internal order, one row per column of P and one more; y: one row per row of P.
  void applyToPoints(const RowMatrixXf& x, const LoadedColumns& loaded, RowMatrixXf& y,
                     const Job& job) const;
  void readWeights(const ByteSource& source);
  template <class Visit>
  void visitColumns(int cluster, std::span<const int> columns, const Visit& visit) const;
  /// The points of some equations, ascending.
  void setPoints(std::span<const int> equations, Scratch& scratch) const;
  /// First of the points [begin, end) in the second son of a cluster.
  std::size_t splitPoints(int cluster, std::size_t begin, std::size_t end,
                          const Scratch& scratch) const;
  /// Fills `right` with the columns of V that are in `columns`, `to` with their places there.
  void unpackColumns(const FarBlock& block, std::span<const int> columns, Scratch& scratch) const;
  /// Fills `left` with the columns of U of points [begin, end) of the scratch.
  void unpackRows(int cluster, const FarBlock& block, std::size_t begin, std::size_t end,
                  Scratch& scratch) const;
  void expandPoints(int cluster, std::size_t begin, std::size_t end, std::span<const int> columns,
                    Scratch& scratch) const;
  /// Sums points to equations with their weights.
  void sumPoints(std::span<const int> equations, Scratch& scratch) const;
  /// A block at points [begin, end) of the scratch.
  struct FarPiece {
    int cluster;
    const FarBlock* block;
    std::size_t begin, end;
  };
  /// False if a dense block reaches the columns, or the rank is above `maxRank`.
  bool appendFarPieces(int cluster, std::size_t begin, std::size_t end,
                       std::span<const int> columns, Eigen::Index maxRank, const Scratch& scratch,
                       std::vector<FarPiece>& to) const;

  CompressedOrder order_;
  std::vector<std::vector<FarBlock>> far_;               ///< per cluster of points
  std::vector<ClusterBasis> bases_;                      ///< per cluster of functions
  std::vector<std::vector<NearBlock>> near_;             ///< per leaf, counted from the first
  BlockRows<PackedBlock> corrections_;                   ///< added to P
  Eigen::SparseMatrix<float, Eigen::RowMajor> weights_;  ///< (equation, point position)
  AveragedBlocks averaged_;                              ///< N
  BlockRows<PackedBlock> rigid_;                         ///< R
};

/// Assembles the operators of quadratic triangles (or other elements with one coefficient per node
/// and slot). `nodes`: positions of the displacement coefficients; `rigid`: of the equations;
/// `tolerance`: of each block, 1e-3 … 1e-6 of its largest rows; `team`: makes this member's share.
/// Throws Cancelled.
CompressedOperators assembleCompressed(const ElementSurface& surface,
                                       const ElementQuadrature& quadrature,
                                       const WeightedEquations& equations,
                                       const std::vector<Eigen::Vector3d>& nodes,
                                       const TractionSlots& slots, const Material& material,
                                       const RigidProducts& rigid, double tolerance, const Job& job,
                                       const Team* team = nullptr);

}  // namespace palpa::bem
