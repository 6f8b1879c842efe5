// Some rows and columns of compressed operators as matrices.
#include <cblas.h>

#include <algorithm>

#include "bem/compressed/compressed_operators.h"

namespace palpa::bem {

using Eigen::Index;
using Eigen::MatrixXf;
using Weights = Eigen::SparseMatrix<float, Eigen::RowMajor>;

template <class Visit>
void CompressedOperators::visitColumns(int cluster, std::span<const int> columns,
                                       const Visit& visit) const {
  const auto [begin, end] = order_.tree.cluster(cluster);
  const int nodes = nodeCount(), slotBegin = 3 * (nodes + order_.firstSlot[begin]),
            slotEnd = 3 * (nodes + order_.firstSlot[end]);
  const auto visitRange = [&](int from, int to, int place) {
    auto at = std::lower_bound(columns.begin(), columns.end(), from);
    for (; at != columns.end() && *at < to; ++at)
      visit(static_cast<Index>(at - columns.begin()), static_cast<Index>(*at - from + place));
  };
  visitRange(3 * begin, 3 * end, 0);
  visitRange(slotBegin, slotEnd, order_.nodeColumns(cluster));
}

void CompressedOperators::ReusedMatrix::setZero(Index rows, Index columns) {
  rows_ = rows;
  columns_ = columns;
  numbers_.assign(static_cast<std::size_t>(rows * columns), 0);
}

void CompressedOperators::setPoints(std::span<const int> equations, Scratch& scratch) const {
  scratch.points.clear();
  for (const int e : equations)
    for (Weights::InnerIterator w(weights_, e); w; ++w)
      scratch.points.push_back(static_cast<int>(w.col()));
  std::sort(scratch.points.begin(), scratch.points.end());
  scratch.points.erase(std::unique(scratch.points.begin(), scratch.points.end()),
                       scratch.points.end());
  scratch.placeOfPoint.resize(order_.points.size());
  for (std::size_t k = 0; k < scratch.points.size(); ++k)
    scratch.placeOfPoint[scratch.points[k]] = static_cast<int>(k);
}

std::size_t CompressedOperators::splitPoints(int cluster, std::size_t begin, std::size_t end,
                                             const Scratch& scratch) const {
  const auto from = scratch.points.begin();
  return static_cast<std::size_t>(std::lower_bound(from + static_cast<std::ptrdiff_t>(begin),
                                                   from + static_cast<std::ptrdiff_t>(end),
                                                   order_.pointBegin(2 * cluster + 2)) -
                                  from);
}

void CompressedOperators::sumPoints(std::span<const int> equations, Scratch& scratch) const {
  const auto points = scratch.ofPoints.matrix();
  scratch.ofEquations.setZero(3 * static_cast<Index>(equations.size()), points.cols());
  for (std::size_t k = 0; k < equations.size(); ++k)
    for (Weights::InnerIterator w(weights_, equations[k]); w; ++w)
      scratch.ofEquations.matrix().middleRows<3>(3 * static_cast<Index>(k)) +=
          w.value() * points.middleRows<3>(3 * static_cast<Index>(scratch.placeOfPoint[w.col()]));
}

void CompressedOperators::expandPoints(int cluster, std::size_t begin, std::size_t end,
                                       std::span<const int> columns, Scratch& scratch) const {
  if (begin == end) return;
  const int first = order_.pointBegin(cluster);
  const auto some = static_cast<Index>(end - begin);
  std::vector<Index> to;
  for (const FarBlock& block : far_[cluster]) {
    to.clear();
    const auto rank = static_cast<std::size_t>(block.rank);
    scratch.right.resize(block.rank, static_cast<Index>(columns.size()));
    visitColumns(block.column, columns, [&](Index place, Index column) {
      const float* V =
          block.V.unpack(static_cast<std::size_t>(column) * rank, rank, scratch.unpacked);
      std::copy_n(V, rank, scratch.right.col(static_cast<Index>(to.size())).data());
      to.push_back(place);
    });
    if (to.empty()) continue;
    scratch.left.resize(block.rank, 3 * some);
    for (Index k = 0; k < some; ++k) {
      const auto row = 3 * static_cast<std::size_t>(scratch.points[begin + k] - first);
      const float* U = block.U.unpack(row * rank, 3 * rank, scratch.unpacked);
      std::copy_n(U, 3 * rank, scratch.left.col(3 * k).data());
    }
    // The columns of a cluster are contiguous, once among the nodes and once among the slots.
    for (std::size_t from = 0; from < to.size();) {
      std::size_t last = from + 1;
      while (last < to.size() && to[last] == to[last - 1] + 1) ++last;
      cblas_sgemm(CblasRowMajor, CblasNoTrans, CblasTrans, static_cast<int>(3 * some),
                  static_cast<int>(last - from), block.rank, 1, scratch.left.data(), block.rank,
                  scratch.right.col(static_cast<Index>(from)).data(), block.rank, 1,
                  scratch.ofPoints.matrix().row(3 * static_cast<Index>(begin)).data() + to[from],
                  static_cast<int>(scratch.ofPoints.matrix().cols()));
      from = last;
    }
  }
  if (order_.tree.isLeaf(cluster)) {
    const int leaf = cluster - ClusterTree::firstOf(order_.tree.levelCount() - 1);
    for (const NearBlock& block : near_[leaf])
      visitColumns(block.column, columns, [&](Index place, Index column) {
        const auto rows = static_cast<std::size_t>(order_.rows(cluster));
        const float* K =
            block.K.unpack(static_cast<std::size_t>(column) * rows, rows, scratch.unpacked);
        for (Index k = 0; k < some; ++k)
          scratch.ofPoints.matrix().col(place).segment<3>(3 * (static_cast<Index>(begin) + k)) +=
              Eigen::Map<const Eigen::Vector3f>(
                  K + 3 * static_cast<std::ptrdiff_t>(scratch.points[begin + k] - first));
      });
    return;
  }
  const std::size_t split = splitPoints(cluster, begin, end, scratch);
  expandPoints(2 * cluster + 1, begin, split, columns, scratch);
  expandPoints(2 * cluster + 2, split, end, columns, scratch);
}

void CompressedOperators::expand(std::span<const int> equations, std::span<const int> columns,
                                 Scratch& scratch) const {
  setPoints(equations, scratch);
  const auto columnCount = static_cast<Index>(columns.size());
  scratch.ofPoints.setZero(3 * static_cast<Index>(scratch.points.size()), columnCount);
  expandPoints(0, 0, scratch.points.size(), columns, scratch);
  scratch.places.resize(3 * (order_.tree.order().size() + order_.slots.size()), -1);
  for (std::size_t k = 0; k < columns.size(); ++k) scratch.places[columns[k]] = static_cast<int>(k);
  const auto addRow = [&](const auto& from, int row, Eigen::Map<RowMatrixXf> matrix, Index k) {
    from.columns.visit(static_cast<std::size_t>(row), [&](std::size_t number, int column) {
      for (int c = 0; c < 3; ++c) {
        const int place = scratch.places[3 * static_cast<std::size_t>(column) + c];
        if (place < 0) continue;
        const BlockNumbers block = numbersOf(from.blocks[number]);
        for (int i = 0; i < 3; ++i) matrix(3 * k + i, place) += block[3 * i + c];
      }
    });
  };
  for (std::size_t k = 0; k < scratch.points.size(); ++k)
    addRow(corrections_, scratch.points[k], scratch.ofPoints.matrix(), static_cast<Index>(k));
  sumPoints(equations, scratch);
  for (std::size_t k = 0; k < equations.size(); ++k) {
    addRow(averaged_.ofNodes, equations[k], scratch.ofEquations.matrix(), static_cast<Index>(k));
    addRow(averaged_.ofSlots, equations[k], scratch.ofEquations.matrix(), static_cast<Index>(k));
  }
  for (const int column : columns) scratch.places[column] = -1;
}

bool CompressedOperators::appendFarPieces(int cluster, std::size_t begin, std::size_t end,
                                          std::span<const int> columns, Index maxRank,
                                          const Scratch& scratch, std::vector<FarPiece>& to) const {
  if (begin == end) return true;
  const auto reaches = [&](int column) {
    bool any = false;
    visitColumns(column, columns, [&](Index, Index) { any = true; });
    return any;
  };
  for (const FarBlock& block : far_[cluster])
    if (reaches(block.column)) to.push_back({cluster, &block, begin, end});
  Index rank = 0;
  for (const FarPiece& piece : to) rank += piece.block->rank;
  if (rank > maxRank) return false;
  if (order_.tree.isLeaf(cluster)) {
    const auto& near = near_[cluster - ClusterTree::firstOf(order_.tree.levelCount() - 1)];
    return std::none_of(near.begin(), near.end(),
                        [&](const NearBlock& block) { return reaches(block.column); });
  }
  const std::size_t split = splitPoints(cluster, begin, end, scratch);
  return appendFarPieces(2 * cluster + 1, begin, split, columns, maxRank, scratch, to) &&
         appendFarPieces(2 * cluster + 2, split, end, columns, maxRank, scratch, to);
}

bool CompressedOperators::expandNarrow(std::span<const int> equations, std::span<const int> columns,
                                       Index maxRank, Scratch& scratch, MatrixXf& left,
                                       MatrixXf& right) const {
  setPoints(equations, scratch);
  std::vector<FarPiece> pieces;
  if (!appendFarPieces(0, 0, scratch.points.size(), columns, maxRank, scratch, pieces))
    return false;
  Index all = 0;
  for (const FarPiece& piece : pieces) all += piece.block->rank;
  if (all == 0) return false;
  scratch.ofPoints.setZero(3 * static_cast<Index>(scratch.points.size()), all);
  right.setZero(static_cast<Index>(columns.size()), all);
  Index at = 0;
  for (const FarPiece& piece : pieces) {
    const auto rank = static_cast<std::size_t>(piece.block->rank);
    const int first = order_.pointBegin(piece.cluster);
    for (std::size_t k = piece.begin; k < piece.end; ++k) {
      const auto row = 3 * static_cast<std::size_t>(scratch.points[k] - first);
      const float* U = piece.block->U.unpack(row * rank, 3 * rank, scratch.unpacked);
      for (std::size_t i = 0; i < 3; ++i)
        std::copy_n(U + i * rank, rank,
                    scratch.ofPoints.matrix().row(static_cast<Index>(3 * k + i)).data() + at);
    }
    visitColumns(piece.block->column, columns, [&](Index place, Index column) {
      const float* V =
          piece.block->V.unpack(static_cast<std::size_t>(column) * rank, rank, scratch.unpacked);
      for (std::size_t r = 0; r < rank; ++r) right(place, at + static_cast<Index>(r)) = V[r];
    });
    at += piece.block->rank;
  }
  sumPoints(equations, scratch);
  left = scratch.ofEquations.matrix();
  return true;
}

void CompressedOperators::appendSparseColumns(std::span<const int> equations,
                                              std::vector<int>& to) const {
  const auto append = [&](const BlockColumns& columns, int row) {
    columns.visit(static_cast<std::size_t>(row),
                  [&](std::size_t, int column) { to.push_back(column); });
  };
  for (const int e : equations) {
    append(averaged_.ofNodes.columns, e);
    append(averaged_.ofSlots.columns, e);
    for (Weights::InnerIterator w(weights_, e); w; ++w)
      append(corrections_.columns, static_cast<int>(w.col()));
  }
}

}  // namespace palpa::bem
