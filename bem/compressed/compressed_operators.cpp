#include "bem/compressed/compressed_operators.h"

#include <cblas.h>

#include <algorithm>

#include "base/parallel.h"
#include "base/scratch_pool.h"
#include "bem/compressed/block_products.h"
#include "bem/compressed/loaded_columns.h"
#include "bem/linalg/single_precision.h"

namespace palpa::bem {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;

namespace {

/// Rows of a matrix: few columns of numbers, `stride` apart, or `columns` numbers per row.
template <class Number>
struct Rows {
  Number* numbers;
  std::ptrdiff_t stride;
};

/// y += A x for x and y with some columns. A: (m, k), by rows or by columns.
void addProduct(bool isByRows, int m, int k, const float* A, int stride, Rows<const float> x,
                int columns, Rows<float> y) {
  if (m == 0 || k == 0) return;
  if (columns > kFewColumns) {
    cblas_sgemm(CblasRowMajor, isByRows ? CblasNoTrans : CblasTrans, CblasNoTrans, m, columns, k, 1,
                A, stride, x.numbers, columns, 1, y.numbers, columns);
    return;
  }
  for (int c = 0; c < columns; ++c)
    cblas_sgemv(isByRows ? CblasRowMajor : CblasColMajor, CblasNoTrans, m, k, 1, A, stride,
                x.numbers + c * x.stride, 1, 1, y.numbers + c * y.stride, 1);
}

/// y += A(row, :) x; x has kReadBehind rows more than A has columns.
template <class Block>
void addRow(const BlockRows<Block>& A, std::size_t row, const RowMatrixXf& x,
            const LoadedColumns& loaded, float* y) {
  static const AddBlockProduct addBlockProduct = addBlockProductForThisProcessor();
  const std::span<const ColumnRun> runs = A.columns.runs(row);
  addBlockProduct(BlockProductTask<Block>{A.blocks.data() + A.columns.begin(row), runs.data(),
                                          runs.size(), x.data(), x.cols(), loaded.few(), y});
}

constexpr int kEquationsPerTask = 64;

}  // namespace

void CompressedOperators::applyToPoints(const RowMatrixXf& x, const LoadedColumns& loaded,
                                        RowMatrixXf& y, const Job& job) const {
  const ClusterTree& tree = order_.tree;
  const auto columns = static_cast<int>(x.cols());
  const Index nodes = nodeCount();
  // First products with all bases, then with the right factors of all blocks, then everything that
  // belongs to the rows of a leaf.
  std::vector<std::vector<std::size_t>> places(far_.size());
  std::vector<std::pair<int, int>> blocks;
  std::vector<std::size_t> placesOfBases;
  std::size_t total = 0, totalOfBases = 0;
  for (std::size_t c = 0; c < far_.size(); ++c)
    for (std::size_t b = 0; b < far_[c].size(); ++b) {
      places[c].push_back(total);
      total += static_cast<std::size_t>(far_[c][b].rank()) * x.cols();
      blocks.emplace_back(static_cast<int>(c), static_cast<int>(b));
    }
  for (const ClusterBasis& basis : bases_) {
    placesOfBases.push_back(totalOfBases);
    totalOfBases += static_cast<std::size_t>(basis.size()) * x.cols();
  }
  std::vector<float> ofBases(totalOfBases, 0);
  std::vector<float> right(total, 0);
  const bool areFew = columns <= kFewColumns;
  const MatrixXf byColumns = areFew ? MatrixXf(x) : MatrixXf();
  const auto rowsOfX = [&](Index row) {
    return Rows<const float>{areFew ? byColumns.data() + row : x.data() + row * columns, x.rows()};
  };
  const auto xOfNodes = [&](int cluster) {
    return rowsOfX(3 * static_cast<Index>(tree.cluster(cluster).begin));
  };
  const auto xOfSlots = [&](int cluster) {
    return rowsOfX(3 * (nodes + order_.firstSlot[tree.cluster(cluster).begin]));
  };
  ScratchPool<std::vector<float>> pool([] { return std::vector<float>(); });
  /// to += V x for V of the functions of a cluster.
  const auto addFunctions = [&](int cluster, const auto& V, int rows, Rows<float> to,
                                std::vector<float>& unpacked) {
    const auto add = [&](const GradedRows& some, int width, Rows<const float> from) {
      const GradedRows::Unpacked numbers = some.unpack(0, width, unpacked);
      addProduct(true, rows, width, numbers.numbers, numbers.stride, from, columns, to);
    };
    add(V.ofNodes, order_.nodeColumns(cluster), xOfNodes(cluster));
    add(V.ofSlots, order_.slotColumns(cluster), xOfSlots(cluster));
  };
  parallelFor(static_cast<std::ptrdiff_t>(bases_.size()), job, [&](std::ptrdiff_t k) {
    const auto cluster = static_cast<int>(k);
    const int size = bases_[cluster].size();
    if (size == 0 || !loaded.reaches(cluster)) return;
    std::vector<float> unpacked = pool.take();
    addFunctions(cluster, bases_[cluster], size, {ofBases.data() + placesOfBases[cluster], size},
                 unpacked);
    pool.giveBack(std::move(unpacked));
  });
  constexpr std::ptrdiff_t kBlocksPerTask = 8;
  const auto count = static_cast<std::ptrdiff_t>(blocks.size());
  parallelFor((count + kBlocksPerTask - 1) / kBlocksPerTask, job, [&](std::ptrdiff_t task) {
    std::vector<float> unpacked = pool.take();
    for (std::ptrdiff_t k = task * kBlocksPerTask; k < std::min(count, (task + 1) * kBlocksPerTask);
         ++k) {
      const auto [c, b] = blocks[k];
      const FarBlock& block = far_[c][b];
      if (!loaded.reaches(block.column)) continue;
      const int rank = block.rank();
      const Rows<float> to{right.data() + places[c][b], rank};
      if (!block.isCombined()) {
        addFunctions(block.column, block, rank, to, unpacked);
        continue;
      }
      const int size = bases_[block.column].size();
      const GradedRows::Unpacked some = block.coefficients.unpack(0, size, unpacked);
      addProduct(true, rank, size, some.numbers, some.stride,
                 {ofBases.data() + placesOfBases[block.column], size}, columns, to);
    }
    pool.giveBack(std::move(unpacked));
  });
  const int firstLeaf = ClusterTree::firstOf(tree.levelCount() - 1);
  y = RowMatrixXf::Zero(3 * static_cast<Index>(order_.points.size()), columns);
  parallelFor(tree.count() - firstLeaf, job, [&](std::ptrdiff_t k) {
    const int leaf = firstLeaf + static_cast<int>(k), first = order_.pointBegin(leaf),
              rows = order_.rows(leaf);
    if (rows == 0) return;
    auto ofLeaf = y.middleRows(3 * static_cast<Index>(first), rows);
    MatrixXf few = MatrixXf::Zero(areFew ? rows : 0, columns);
    const Rows<float> to{areFew ? few.data() : ofLeaf.data(), rows};
    std::vector<float> unpacked = pool.take();
    for (int c = leaf;; c = (c - 1) / 2) {
      for (std::size_t b = 0; b < far_[c].size(); ++b) {
        if (!loaded.reaches(far_[c][b].column)) continue;
        const int rank = far_[c][b].rank();
        const GradedRows::Unpacked U =
            far_[c][b].U.unpack(3 * (first - order_.pointBegin(c)), rows, unpacked);
        addProduct(false, rows, rank, U.numbers, U.stride, {right.data() + places[c][b], rank},
                   columns, to);
      }
      if (c == 0) break;
    }
    for (const NearBlock& block : near_[k]) {
      if (!loaded.reaches(block.column)) continue;
      const int ofNodes = order_.nodeColumns(block.column);
      const float* K = block.K.unpack(unpacked);
      addProduct(false, rows, ofNodes, K, rows, xOfNodes(block.column), columns, to);
      addProduct(false, rows, order_.slotColumns(block.column),
                 K + static_cast<std::ptrdiff_t>(ofNodes) * rows, rows, xOfSlots(block.column),
                 columns, to);
    }
    pool.giveBack(std::move(unpacked));
    if (areFew) ofLeaf = few;
    for (int point = first; point < order_.pointEnd(leaf); ++point)
      addRow(corrections_, static_cast<std::size_t>(point), x, loaded,
             y.row(3 * static_cast<Index>(point)).data());
  });
}

MatrixXd CompressedOperators::apply(const MatrixXd& u, const MatrixXd& p, const Job& job) const {
  // Loads reach few blocks, so that finding these takes longer than multiplying them.
  const Index columnsAtOnce = u.isZero(0) ? 96 : 32;
  const Index nodes = nodeCount(), slots = static_cast<Index>(order_.slots.size()),
              equations = equationCount();
  MatrixXd result(3 * equations, u.cols());
  for (Index first = 0; first < u.cols(); first += columnsAtOnce) {
    const Index columns = std::min(columnsAtOnce, u.cols() - first);
    RowMatrixXf x(3 * (nodes + slots) + kReadBehind, columns), y;
    x.bottomRows<kReadBehind>().setZero();
    for (Index k = 0; k < nodes; ++k)
      x.middleRows(3 * k, 3) =
          u.block(3 * static_cast<Index>(order_.tree.order()[k]), first, 3, columns).cast<float>();
    for (Index s = 0; s < slots; ++s)
      x.middleRows(3 * (nodes + s), 3) =
          p.block(3 * static_cast<Index>(order_.slots[s]), first, 3, columns).cast<float>();
    const LoadedColumns loaded(order_, x);
    applyToPoints(x, loaded, y, job);
    parallelFor(
        (equations + kEquationsPerTask - 1) / kEquationsPerTask, job, [&](std::ptrdiff_t task) {
          // In double precision: a team's sum differs by the rounding of points alone.
          Eigen::Matrix<double, 3, Eigen::Dynamic> sum(3, columns);
          RowMatrixXf averaged(3, columns);
          for (Index e = task * kEquationsPerTask;
               e < std::min<Index>(equations, (task + 1) * kEquationsPerTask); ++e) {
            sum.setZero();
            for (Eigen::SparseMatrix<float, Eigen::RowMajor>::InnerIterator w(weights_, e); w; ++w)
              sum += static_cast<double>(w.value()) * y.middleRows(3 * w.col(), 3).cast<double>();
            averaged.setZero();
            const auto row = static_cast<std::size_t>(e);
            addRow(averaged_.ofNodes, row, x, loaded, averaged.data());
            addRow(averaged_.ofSlots, row, x, loaded, averaged.data());
            addRow(rigid_, row, x, loaded, averaged.data());
            sum += averaged.cast<double>();
            for (int i = 0; i < 3; ++i)
              result.row(i * equations + e).segment(first, columns) = sum.row(i);
          }
        });
  }
  return result;
}

}  // namespace palpa::bem
