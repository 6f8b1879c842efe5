#include "bem/compressed/compressed_reference_problem.h"

#include <lapacke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/byte_reader.h"
#include "base/parallel.h"
#include "base/scratch_pool.h"
#include "bem/base/error.h"
#include "bem/linalg/gmres.h"

namespace palpa::bem {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;

namespace {

/// Tiles of the system: the equations and unknowns of the nodes of a cluster.
class SystemTiles {
 public:
  SystemTiles(const DegreesOfFreedom& dofs, const CompressedOperators& operators, int tileNodes)
      : operators_(operators) {
    const CompressedOrder& order = operators.order();
    const int level = order.tree.levelOfSize(tileNodes);
    std::vector<std::vector<int>> extraOfNode(static_cast<std::size_t>(dofs.nodeCount()));
    std::vector<int> nodeOfSlot(order.slots.size());
    for (int k = 0; k < dofs.nodeCount(); ++k)
      for (int s = order.firstSlot[k]; s < order.firstSlot[k + 1]; ++s)
        nodeOfSlot[order.slots[s]] = order.tree.order()[k];
    for (std::size_t k = 0; k < dofs.extraSlots().size(); ++k)
      extraOfNode[nodeOfSlot[dofs.extraSlots()[k]]].push_back(dofs.nodeCount() +
                                                              static_cast<int>(k));
    for (int c = ClusterTree::firstOf(level); c < ClusterTree::firstOf(level + 1); ++c) {
      Tile& tile = tiles_.emplace_back();
      for (int k = order.tree.cluster(c).begin; k < order.tree.cluster(c).end; ++k) {
        const int node = order.tree.order()[k];
        tile.equations.push_back(node);
        const auto& extra = extraOfNode[node];
        tile.equations.insert(tile.equations.end(), extra.begin(), extra.end());
      }
      setColumns(dofs, tile);
      tile.isZero = !operators_.reaches(tile.equations);
    }
    markSparse();
  }

  std::vector<int> sizes() const {
    std::vector<int> sizes;
    for (const Tile& tile : tiles_) sizes.push_back(3 * static_cast<int>(tile.equations.size()));
    return sizes;
  }
  std::vector<int> equations() const {
    std::vector<int> all;
    for (const Tile& tile : tiles_)
      all.insert(all.end(), tile.equations.begin(), tile.equations.end());
    return all;
  }

  LowRankTile make(int row, int column, CompressedOperators::Scratch& scratch) const {
    const std::vector<int>& equations = tiles_[row].equations;
    const Tile& of = tiles_[column];
    LowRankTile result;
    if (tiles_[row].isZero) return result;
    if (!tiles_[row].isSparseAt[column]) {
      const auto smaller = static_cast<Index>(std::min(3 * equations.size(), of.columns.size()));
      MatrixXf right;
      if (operators_.expandNarrow(equations, of.columns, smaller / 2, scratch, result.X, right)) {
        result.Y = of.combined.transpose() * right;
        return result;
      }
    }
    operators_.expand(equations, of.columns, scratch);
    result.X = combine(scratch.ofEquations.matrix(), of.combined);
    return result;
  }

 private:
  struct Tile {
    std::vector<int> equations;           ///< and the unknowns 3 e, 3 e + 1, 3 e + 2 of each
    std::vector<int> columns;             ///< of the operators
    Eigen::SparseMatrix<float> combined;  ///< (column of the operators, unknown)
    bool isZero = false;                  ///< other members have its blocks
    std::vector<char> isSparseAt;         ///< per tile: sparse blocks of the equations reach there
  };

  /// A0 v = -[-H G] of the field of v.
  void setColumns(const DegreesOfFreedom& dofs, Tile& tile) const {
    const CompressedOrder& order = operators_.order();
    std::vector<Eigen::Triplet<float>> entries;
    int unknown = 0;
    const auto add = [&](int column, double value) {
      if (value != 0) entries.emplace_back(column, unknown, static_cast<float>(-value));
    };
    for (const int e : tile.equations)
      for (int dof = 3 * e; dof < 3 * e + 3; ++dof, ++unknown) {
        if (dof < dofs.nodalCount() && !dofs.isConstrained(dof)) {
          for (int i = 0; i < 3; ++i)
            add(3 * order.tree.positionOf()[e] + i, dofs.frame(e)(i, dof % 3));
        } else {
          for (const auto& weight : dofs.tractionOf(dof))
            for (int i = 0; i < 3; ++i)
              add(3 * (dofs.nodeCount() + order.slotPositionOf[weight.slot]) + i,
                  weight.traction[i]);
        }
      }
    for (const auto& entry : entries) tile.columns.push_back(entry.row());
    std::sort(tile.columns.begin(), tile.columns.end());
    tile.columns.erase(std::unique(tile.columns.begin(), tile.columns.end()), tile.columns.end());
    for (auto& entry : entries)
      entry = {
          static_cast<int>(std::lower_bound(tile.columns.begin(), tile.columns.end(), entry.row()) -
                           tile.columns.begin()),
          entry.col(), entry.value()};
    tile.combined.resize(static_cast<Index>(tile.columns.size()), unknown);
    tile.combined.setFromTriplets(entries.begin(), entries.end());
  }

  /// columns * combined; by parts of the rows, which stay in the cache while they are turned.
  static MatrixXf combine(const Eigen::Map<RowMatrixXf>& columns,
                          const Eigen::SparseMatrix<float>& combined) {
    constexpr Index kRows = 16;
    MatrixXf result = MatrixXf::Zero(columns.rows(), combined.cols());
    for (Index first = 0; first < columns.rows(); first += kRows) {
      const Index rows = std::min(kRows, columns.rows() - first);
      for (Index k = 0; k < combined.cols(); ++k)
        for (Eigen::SparseMatrix<float>::InnerIterator entry(combined, k); entry; ++entry)
          result.col(k).segment(first, rows) +=
              entry.value() * columns.col(entry.row()).segment(first, rows);
    }
    return result;
  }

  void markSparse() {
    const CompressedOrder& order = operators_.order();
    std::vector<int> tileOf(order.positionCount() + order.slots.size(), -1), reached;
    for (std::size_t t = 0; t < tiles_.size(); ++t)
      for (const int column : tiles_[t].columns) tileOf[column / 3] = static_cast<int>(t);
    for (Tile& tile : tiles_) {
      tile.isSparseAt.resize(tiles_.size());
      reached.clear();
      operators_.appendSparseColumns(tile.equations, reached);
      for (const int column : reached)
        if (tileOf[column] >= 0) tile.isSparseAt[tileOf[column]] = 1;
    }
  }

  const CompressedOperators& operators_;
  std::vector<Tile> tiles_;
};

/// Nodes per tile: large enough that the tiles, whose number grows with the square of the number of
/// nodes over this, do not take most of the time; small enough for the dense ones on the diagonal.
int tileNodesFor(int nodes) {
  return std::clamp(nodes / 40, 160, 300);
}

}  // namespace

CompressedReferenceProblem::CompressedReferenceProblem(DegreesOfFreedom dofMap,
                                                       CompressedOperators operators,
                                                       const CompressionOptions& options,
                                                       const Job& job, const Team* team)
    : ReferenceProblem(std::move(dofMap), kRefinement), operators_(std::move(operators)) {
  const SystemTiles tiles(
      dofs(), operators_,
      options.tileNodes > 0 ? options.tileNodes : tileNodesFor(dofs().nodeCount()));
  equations_ = tiles.equations();
  ScratchPool<CompressedOperators::Scratch> pool([] { return CompressedOperators::Scratch{}; });
  factors_ = std::make_unique<TileLu>(
      tiles.sizes(), static_cast<float>(options.factors),
      [&](int row, int column) {
        CompressedOperators::Scratch scratch = pool.take();
        LowRankTile tile = tiles.make(row, column, scratch);
        pool.giveBack(std::move(scratch));
        return tile;
      },
      job, team);
}

MatrixXd CompressedReferenceProblem::residual(const BoundaryField& field, const Job& job) const {
  return operators_.apply(field.u, field.p, job);
}

MatrixXd CompressedReferenceProblem::precondition(const MatrixXd& r, const Job& job) const {
  const auto m = static_cast<Index>(equations_.size());
  MatrixXf x(r.rows(), r.cols());
  parallelFor(r.cols(), job, [&](std::ptrdiff_t c) {
    for (Index k = 0; k < m; ++k)
      for (int i = 0; i < 3; ++i) x(3 * k + i, c) = static_cast<float>(r(i * m + equations_[k], c));
  });
  factors_->solveInPlace(x, job);
  MatrixXd v(r.rows(), r.cols());
  parallelFor(r.cols(), job, [&](std::ptrdiff_t c) {
    for (Index k = 0; k < m; ++k)
      v.col(c).segment<3>(3 * static_cast<Index>(equations_[k])) =
          x.col(c).segment<3>(3 * k).cast<double>();
  });
  return v;
}

MatrixXd CompressedReferenceProblem::correction(const MatrixXd& r, const Job& job) const {
  constexpr int kMaxSteps = 60;
  // Each column is scaled to 1, so that single precision neither overflows nor loses small states.
  const Eigen::RowVectorXd scale = r.colwise().norm().cwiseMax(1e-300);
  const GmresSolution solution = gmres(
      [&](const MatrixXd& y) {
        return MatrixXd(-residual(dofs().expand(precondition(y, job), MatrixXd()), job));
      },
      r * scale.cwiseInverse().asDiagonal(), kTolerance, kMaxSteps, job);
  if (!(solution.residual <= 100 * kTolerance))  // also if it is not a number
    throw SolverError(SolverError::Kind::kBadCondition,
                      "the equations of the compressed operators were solved only to " +
                          std::to_string(solution.residual) +
                          "; check the mesh for degenerate places, or take a coarser mesh, which "
                          "is solved without compression");
  return precondition(solution.x, job) * scale.asDiagonal();
}

MatrixXd CompressedReferenceProblem::fastCorrection(const MatrixXd& r, const Job& job) const {
  constexpr int kMaxRounds = 3;
  // Relative error of the field; forces have a far smaller one.
  constexpr double kRemaining = 2e-4;
  MatrixXd v = precondition(r, job);
  using Norms = Eigen::Array<double, 1, Eigen::Dynamic>;  // of each column
  Norms previous = v.colwise().norm();
  for (int round = 0; round < kMaxRounds; ++round) {
    const MatrixXd step = precondition(r + residual(dofs().expand(v, MatrixXd()), job), job);
    const Norms change = step.colwise().norm();
    v += step;
    // The next step would be smaller than this one as this one is smaller than the former.
    if ((change.square() <= kRemaining * previous * v.colwise().norm().array()).all()) return v;
    previous = change;
  }
  return correction(r, job);
}

double CompressedReferenceProblem::conditionEstimate(const Job& job) const {
  const auto n = static_cast<lapack_int>(factors_->size());
  // Zero, because LAPACKE refuses numbers that are not finite before they are set.
  MatrixXf v = MatrixXf::Zero(n, 1), x = MatrixXf::Zero(n, 1);
  std::vector<lapack_int> signs(static_cast<std::size_t>(n));
  std::array<lapack_int, 3> saved{};
  float inverseNorm = 0;
  lapack_int next = 0;
  for (;;) {
    LAPACKE_slacn2(n, v.data(), x.data(), signs.data(), &inverseNorm, &next, saved.data());
    if (next == 0) break;
    if (next == 1)
      factors_->solveInPlace(x, job);
    else
      factors_->solveTransposedInPlace(x, job);
  }
  const double estimate = static_cast<double>(inverseNorm) * factors_->norm1();
  return std::isfinite(estimate) ? estimate : std::numeric_limits<double>::infinity();
}

void CompressedReferenceProblem::write(const ByteSink& sink) const {
  operators_.write(sink);
  writeList(sink, equations_);
  factors_->write(sink);
  writeList(sink, knownColumns_.nodes);
  writeNumbers(sink, knownColumns_.values);
}

CompressedReferenceProblem::CompressedReferenceProblem(DegreesOfFreedom dofMap,
                                                       const ByteSource& source)
    : ReferenceProblem(std::move(dofMap), kRefinement),
      operators_(source),
      equations_(readList<int>(source)) {
  if (operators_.nodeCount() != dofs().nodeCount() ||
      static_cast<int>(operators_.order().slots.size()) != dofs().slotCount() ||
      3 * operators_.equationCount() != dofs().count() ||
      3 * static_cast<int>(equations_.size()) != dofs().count())
    throw DamagedData();
  factors_ = std::make_unique<TileLu>(dofs().count(), source);
  knownColumns_.nodes = readList<int>(source);
  if (static_cast<int>(knownColumns_.nodes.size()) > dofs().nodeCount()) throw DamagedData();
  for (const int node : knownColumns_.nodes)
    if (node < 0 || node >= dofs().nodeCount()) throw DamagedData();
  knownColumns_.values.resize(dofs().count(), 3 * static_cast<Index>(knownColumns_.nodes.size()));
  readNumbers(source, knownColumns_.values);
}

std::shared_ptr<GreensColumns> makeGreensColumns(std::shared_ptr<const ReferenceProblem> problem) {
  const auto* compressed = dynamic_cast<const CompressedReferenceProblem*>(problem.get());
  auto columns = std::make_shared<GreensColumns>(std::move(problem));
  if (compressed) columns->take(compressed->knownColumns());
  return columns;
}

}  // namespace palpa::bem
