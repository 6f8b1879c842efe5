#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "base/part_of_job.h"
#include "base/scratch_pool.h"
#include "bem/base/team_data.h"
#include "bem/compressed/averaged_blocks.h"
#include "bem/compressed/compressed_operators.h"
#include "bem/compressed/loaded_columns.h"
#include "bem/element/averaged_rows.h"
#include "bem/element/kelvin_blocks.h"
#include "bem/element/rigid_motions.h"
#include "bem/linalg/blas_threads.h"
#include "bem/quadratic/rigid_products.h"

namespace palpa::bem {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::MatrixXf;
using Eigen::Vector3d;

/// One assembly: makes the blocks and corrects the rows so that rigid motions have no residual.
class CompressedAssembly {
 public:
  CompressedAssembly(const ElementSurface& surface, const ElementQuadrature& quadrature,
                     const WeightedEquations& equations, const std::vector<Vector3d>& nodes,
                     const TractionSlots& slots, const Material& material,
                     const RigidProducts& rigid, const Job& job, const Team* team)
      : surface_(surface),
        quadrature_(quadrature),
        equations_(equations),
        nodes_(nodes),
        slots_(slots),
        shear_(material.shear()),
        rigid_(rigid),
        job_(job),
        team_(team),
        share_(team),
        constants_(ElementRows(surface, quadrature, material).constants()),
        averaged_(surface, quadrature, constants_, equations, std::nullopt),
        order_(makeCompressedOrder(surface, equations, nodes, slots)),
        exact_(surface, quadrature, constants_, order_) {
    useOneBlasThread();
    for (const int p : order_.points) points_.push_back(equations.points[p].position);
    division_ = divideBlocks(order_, exact_, surface_, points_, nodes_, job_);
  }

  CompressedOperators run(double tolerance) {
    result_.order_ = order_;
    setWeights();
    setLeaves();
    FarBlocks far = makeFarBlocks({order_, division_, exact_, equations_, points_, nodes_, slots_,
                                   constants_, shear_, tolerance, share_, team_ == nullptr},
                                  partOfJob(job_, 0, 0.5));
    result_.far_ = std::move(far.blocks);
    result_.bases_ = std::move(far.bases);
    addNearBlocks(partOfJob(job_, 0.5, 0.65));
    const std::vector<AveragedRows::Total> totals = addCorrections(partOfJob(job_, 0.65, 0.75));
    const std::vector<char> isInShareOf = equationsOfShare();
    result_.averaged_ = makeAveragedBlocks(order_, surface_, equations_, averaged_, totals,
                                           isInShareOf, partOfJob(job_, 0.75, 1));
    addRigidCorrections(isInShareOf);
    return std::move(result_);
  }

 private:
  const ClusterTree& tree() const { return order_.tree; }
  const CollocationPlace& point(int position) const {
    return equations_.points[order_.points[position]];
  }

  void setWeights() {
    std::vector<Eigen::Triplet<float>> weights;
    for (Index p = 0; p < equations_.weights.cols(); ++p)
      for (Eigen::SparseMatrix<double>::InnerIterator w(equations_.weights, p); w; ++w)
        weights.emplace_back(static_cast<int>(w.row()), order_.pointPositionOf[p],
                             static_cast<float>(w.value()));
    result_.weights_.resize(equations_.weights.rows(), equations_.weights.cols());
    result_.weights_.setFromTriplets(weights.begin(), weights.end());
  }

  void setLeaves() {
    leafOfPoint_.resize(equations_.points.size());
    for (std::size_t position = 0; position < order_.positionCount(); ++position)
      for (int p = order_.firstPoint[position]; p < order_.firstPoint[position + 1]; ++p)
        leafOfPoint_[p] = tree().leafOf(static_cast<int>(position));
  }

  bool isInShare(int position) const { return share_.hasRows(leafOfPoint_[position]); }

  /// Whether N of an equation is in the share: with the rows of its first point.
  std::vector<char> equationsOfShare() const {
    std::vector<char> isInShareOf(static_cast<std::size_t>(result_.equationCount()));
    for (int e = 0; e < result_.equationCount(); ++e) {
      const Eigen::SparseMatrix<float, Eigen::RowMajor>::InnerIterator first(result_.weights_, e);
      isInShareOf[e] = first ? isInShare(static_cast<int>(first.col())) : share_.hasRows(0);
    }
    return isInShareOf;
  }

  void addNearBlocks(const Job& job) {
    const int firstLeaf = ClusterTree::firstOf(tree().levelCount() - 1);
    result_.near_.resize(static_cast<std::size_t>(tree().count() - firstLeaf));
    ScratchPool<ExactRows::Scratch> pool([&] { return exact_.makeScratch(); });
    parallelFor(tree().count() - firstLeaf, job, Phase::kAssemble, [&](std::ptrdiff_t k) {
      const int leaf = firstLeaf + static_cast<int>(k);
      ExactRows::Scratch scratch = pool.take();
      RowMatrixXf ofPoint;
      for (std::size_t b = 0; b < division_.near[leaf].size(); ++b) {
        if (!share_.hasBlock(leaf, b)) continue;
        job.throwIfCancelled();
        const int column = division_.near[leaf][b];
        MatrixXf K(order_.rows(leaf), order_.columns(column));
        ofPoint.resize(3, K.cols());
        for (int p = order_.pointBegin(leaf); p < order_.pointEnd(leaf); ++p) {
          exact_.compute(point(p), column, leftOut(p), scratch, ofPoint.data());
          K.middleRows<3>(3 * static_cast<Index>(p - order_.pointBegin(leaf))) = ofPoint;
        }
        if (!K.isZero(0)) result_.near_[k].push_back({column, PackedNumbers(K)});
      }
      pool.giveBack(std::move(scratch));
    });
  }

  /// Takes the elements that a point leaves out from its distant blocks.
  void subtractLeftOut(int position, ExactRows::Scratch& scratch, BlockRowEntries& row) const {
    const int leaf = leafOfPoint_[position];
    for (const int e : leftOut(position)) {
      const std::vector<int>&nodes = surface_.coefficients(e), &slots = surface_.slots(e);
      const auto isDistant = [&](int node) {
        return !division_.isNear(leaf, tree().leafOf(tree().positionOf()[node]));
      };
      if (std::none_of(nodes.begin(), nodes.end(), isDistant)) continue;
      quadrature_.integrate(e, point(position).position, placeIn(point(position), e),
                            *scratch.quadrature);
      for (std::size_t f = 0; f < nodes.size(); ++f) {
        if (!isDistant(nodes[f])) continue;
        const double* sums = scratch.quadrature->sums[f].of;
        Matrix3d T, U;
        for (int i = 0; i < 3; ++i)
          for (int c = 0; c < 3; ++c) {
            T(i, c) = detail::BlockT::component(constants_, sums + kKernelSumsU, i, c);
            U(i, c) = detail::BlockU::component(constants_, sums, i, c);
          }
        row.emplace_back(tree().positionOf()[nodes[f]], T);
        row.emplace_back(result_.nodeCount() + order_.slotPositionOf[slots[f]], -U);
      }
    }
  }

  /// Functions at a point that leaves out no element, ascending by position.
  std::vector<std::pair<int, double>> functionsAt(int position) const {
    const ElementPlace& place = point(position).places.front();
    std::vector<double> basis;
    surface_.evaluateBasis(place, basis);
    std::vector<std::pair<int, double>> functions;
    for (std::size_t f = 0; f < basis.size(); ++f)
      if (basis[f] != 0)
        functions.emplace_back(tree().positionOf()[surface_.coefficients(place.element)[f]],
                               basis[f]);
    std::sort(functions.begin(), functions.end());
    return functions;
  }

  std::span<const int> leftOut(int position) const {
    return averaged_.leftOut(static_cast<std::size_t>(order_.points[position]));
  }

  /// Completes P; returns the sums of its rows in the form of AveragedRows.
  std::vector<AveragedRows::Total> addCorrections(const Job& job) {
    const auto points = static_cast<std::ptrdiff_t>(equations_.points.size());
    std::vector<BlockRow> rows(equations_.points.size());
    struct Scratch {
      ExactRows::Scratch rows;
      BlockRowEntries entries;
    };
    ScratchPool<Scratch> pool([&] { return Scratch{exact_.makeScratch(), {}}; });
    constexpr std::ptrdiff_t kPointsPerTask = 16;
    parallelFor((points + kPointsPerTask - 1) / kPointsPerTask, job, Phase::kAssemble,
                [&](std::ptrdiff_t task) {
                  Scratch scratch = pool.take();
                  for (auto p = static_cast<int>(task * kPointsPerTask);
                       p < std::min(points, (task + 1) * kPointsPerTask); ++p) {
                    if (!isInShare(p)) continue;
                    scratch.entries.clear();
                    if (!leftOut(p).empty()) {
                      subtractLeftOut(p, scratch.rows, scratch.entries);
                      rows[p] = mergedRow(scratch.entries);
                      continue;
                    }
                    for (const auto& [column, value] : functionsAt(p))
                      rows[p].columns.push_back(column);
                    rows[p].columns.push_back(rows[p].columns.front());  // see packRow()
                    rows[p].blocks.resize(rows[p].columns.size());
                  }
                  pool.giveBack(std::move(scratch));
                });
    result_.corrections_ = joined(std::move(rows));
    RowMatrixXf translations = RowMatrixXf::Zero(
                    3 * (result_.nodeCount() + static_cast<Index>(order_.slots.size())) + 1, 3),
                sums;
    for (Index k = 0; k < result_.nodeCount(); ++k) translations.middleRows<3>(3 * k).setIdentity();
    result_.applyToPoints(translations, LoadedColumns(order_, translations), sums, job);
    if (team_) sums = sumOverTeam(*team_, sums);
    std::vector<AveragedRows::Total> totals(equations_.points.size());
    std::vector<BlockNumbers> blocks;
    for (int p = 0; p < points; ++p) {
      const Matrix3d sum = sums.middleRows<3>(3 * static_cast<Index>(p)).cast<double>();
      totals[order_.points[p]] = totalOf(-sum);
      if (!leftOut(p).empty() || !isInShare(p)) continue;
      blocks.clear();
      for (const auto& [column, value] : functionsAt(p)) {
        BlockNumbers& block = blocks.emplace_back();
        for (int i = 0; i < 3; ++i)
          for (int c = 0; c < 3; ++c) block[3 * i + c] = static_cast<float>(-value * sum(i, c));
      }
      BlockRows<PackedBlock>& to = result_.corrections_;
      const auto row = static_cast<std::size_t>(p);
      const std::size_t begin = to.columns.begin(row),
                        largest =
                            packRow(blocks, std::span(to.blocks).subspan(begin, blocks.size() + 1));
      to.columns.repeatColumnAtEnd(row, begin + largest);
    }
    return totals;
  }

  /// Makes R of what P and N leave.
  void addRigidCorrections(const std::vector<char>& isWanted) {
    const auto count = static_cast<Index>(isWanted.size());
    std::vector<BlockRow> rows(isWanted.size());
    result_.rigid_ = joined(rows);
    const MatrixXd none = MatrixXd::Zero(3 * static_cast<Index>(order_.slots.size()), 6);
    MatrixXd residuals = result_.apply(rigid_.motions, none, job_);
    if (team_) residuals = sumOverTeam(*team_, residuals);
    residuals += rigid_.products;  // of H, the others are of -H
    const RigidCorrection correction(surface_, equations_, rigid_.motions);
    constexpr Index kPerTask = 64;
    parallelFor((count + kPerTask - 1) / kPerTask, job_, [&](std::ptrdiff_t task) {
      BlockRowEntries entries;
      for (Index e = task * kPerTask; e < std::min(count, (task + 1) * kPerTask); ++e) {
        if (!isWanted[e] || !rigid_.areKnown[e]) continue;
        entries.clear();
        for (const auto& [node, block] :
             correction.blocks(e, residuals(Eigen::seqN(e, 3, count), Eigen::all)))
          entries.emplace_back(tree().positionOf()[node], block);
        rows[e] = mergedRow(entries);
      }
    });
    result_.rigid_ = joined(std::move(rows));
  }

  /// The sums of Kelvin's kernels whose block is `T`.
  AveragedRows::Total totalOf(const Matrix3d& T) const {
    const Matrix3d block = T / constants_.weightT;
    const double d = constants_.diagonalT, trace = block.trace() / (3 + 3 * d);
    AveragedRows::Total total{};
    for (int i = 0; i < 3; ++i) {
      const int c = (i + 1) % 3;
      total[detail::kPackedSum[i][i]] = (block(i, i) - d * trace) / 3;
      total[detail::kPackedSum[i][c]] = (block(i, c) + block(c, i)) / 6;
      // Without a factor there is no such term.
      total[6 + 3 - i - c] = d > 0 ? (block(c, i) - block(i, c)) / (2 * d) : 0;
    }
    return total;
  }

  const ElementSurface& surface_;
  const ElementQuadrature& quadrature_;
  const WeightedEquations& equations_;
  const std::vector<Vector3d>& nodes_;
  const TractionSlots& slots_;
  const double shear_;  ///< MPa
  const RigidProducts& rigid_;
  const Job& job_;
  const Team* const team_;
  const BlockShare share_;
  const KelvinConstants constants_;
  const AveragedRows averaged_;
  const CompressedOrder order_;
  const ExactRows exact_;
  std::vector<Vector3d> points_;  ///< by position
  BlockDivision division_;
  std::vector<int> leafOfPoint_;
  CompressedOperators result_;
};

CompressedOperators assembleCompressed(const ElementSurface& surface,
                                       const ElementQuadrature& quadrature,
                                       const WeightedEquations& equations,
                                       const std::vector<Vector3d>& nodes,
                                       const TractionSlots& slots, const Material& material,
                                       const RigidProducts& rigid, double tolerance, const Job& job,
                                       const Team* team) {
  material.validate();
  return CompressedAssembly(surface, quadrature, equations, nodes, slots, material, rigid, job,
                            team)
      .run(tolerance);
}

}  // namespace palpa::bem
