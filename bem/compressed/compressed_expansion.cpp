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

void CompressedOperators::unpackColumns(const FarBlock& block, std::span<const int> columns,
                                        Scratch& scratch) const {
  scratch.to.clear();
  scratch.from.clear();
  visitColumns(block.column, columns, [&](Index place, Index column) {
    scratch.to.push_back(place);
    scratch.from.push_back(static_cast<int>(column));
  });
  const std::vector<int>& from = scratch.from;
  const int ofNodes = order_.nodeColumns(block.column);
  const auto split = std::lower_bound(from.begin(), from.end(), ofNodes) - from.begin();
  const auto copy = [&](const GradedRows& V, int first, std::ptrdiff_t begin, std::ptrdiff_t end,
                        RowMatrixXf& to) {
    if (begin == end) return;
    const int least = from[begin];
    const GradedRows::Unpacked some =
        V.unpack(least - first, from[end - 1] + 1 - least, scratch.unpacked);
    for (int r = 0; r < V.rowCount(); ++r) {
      const float* row = some.numbers + static_cast<std::ptrdiff_t>(r) * some.stride;
      for (std::ptrdiff_t k = begin; k < end; ++k) to(r, k) = row[from[k] - least];
    }
  };
  const auto copyBoth = [&](const auto& V, int rows, RowMatrixXf& to) {
    to.resize(rows, static_cast<Index>(from.size()));
    copy(V.ofNodes, 0, 0, split, to);
    copy(V.ofSlots, ofNodes, split, static_cast<std::ptrdiff_t>(from.size()), to);
  };
  if (!block.isCombined()) {
    copyBoth(block, block.rank(), scratch.right);
    return;
  }
  const ClusterBasis& basis = bases_[block.column];
  scratch.right.resize(block.rank(), static_cast<Index>(from.size()));
  if (from.empty()) return;
  copyBoth(basis, basis.size(), scratch.ofBasis);
  const GradedRows::Unpacked some =
      block.coefficients.unpack(0, basis.size(), scratch.unpackedCoefficients);
  cblas_sgemm(CblasRowMajor, CblasNoTrans, CblasNoTrans, block.rank(),
              static_cast<int>(from.size()), basis.size(), 1, some.numbers, some.stride,
              scratch.ofBasis.data(), static_cast<int>(from.size()), 0, scratch.right.data(),
              static_cast<int>(from.size()));
}

void CompressedOperators::unpackRows(int cluster, const FarBlock& block, std::size_t begin,
                                     std::size_t end, Scratch& scratch) const {
  const std::vector<int>& points = scratch.points;
  const int first = points[begin], rank = block.rank();
  scratch.left.resize(rank, 3 * static_cast<Index>(end - begin));
  const GradedRows::Unpacked U =
      block.U.unpack(3 * (first - order_.pointBegin(cluster)), 3 * (points[end - 1] + 1 - first),
                     scratch.unpacked);
  for (int r = 0; r < rank; ++r) {
    const float* row = U.numbers + static_cast<std::ptrdiff_t>(r) * U.stride;
    float* to = scratch.left.row(r).data();
    for (std::size_t k = begin; k < end; ++k, to += 3)
      std::copy_n(row + 3 * (points[k] - first), 3, to);
  }
}

void CompressedOperators::expandPoints(int cluster, std::size_t begin, std::size_t end,
                                       std::span<const int> columns, Scratch& scratch) const {
  if (begin == end) return;
  const int first = order_.pointBegin(cluster);
  const auto some = static_cast<Index>(end - begin);
  for (const FarBlock& block : far_[cluster]) {
    unpackColumns(block, columns, scratch);
    if (scratch.to.empty()) continue;
    unpackRows(cluster, block, begin, end, scratch);
    // The columns of a cluster are contiguous, once among the nodes and once among the slots.
    for (std::size_t from = 0; from < scratch.to.size();) {
      std::size_t last = from + 1;
      while (last < scratch.to.size() && scratch.to[last] == scratch.to[last - 1] + 1) ++last;
      cblas_sgemm(
          CblasRowMajor, CblasTrans, CblasNoTrans, static_cast<int>(3 * some),
          static_cast<int>(last - from), block.rank(), 1, scratch.left.data(),
          static_cast<int>(scratch.left.cols()), scratch.right.data() + from,
          static_cast<int>(scratch.right.cols()), 1,
          scratch.ofPoints.matrix().row(3 * static_cast<Index>(begin)).data() + scratch.to[from],
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
    addRow(rigid_, equations[k], scratch.ofEquations.matrix(), static_cast<Index>(k));
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
  for (const FarPiece& piece : to) rank += piece.block->rank();
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
  for (const FarPiece& piece : pieces) all += piece.block->rank();
  if (all == 0) return false;
  scratch.ofPoints.setZero(3 * static_cast<Index>(scratch.points.size()), all);
  right.setZero(static_cast<Index>(columns.size()), all);
  Index at = 0;
  for (const FarPiece& piece : pieces) {
    const Index rank = piece.block->rank();
    unpackRows(piece.cluster, *piece.block, piece.begin, piece.end, scratch);
    scratch.ofPoints.matrix().block(3 * static_cast<Index>(piece.begin), at, scratch.left.cols(),
                                    rank) = scratch.left.transpose();
    unpackColumns(*piece.block, columns, scratch);
    for (Index r = 0; r < rank; ++r)
      for (std::size_t k = 0; k < scratch.to.size(); ++k)
        right(scratch.to[k], at + r) = scratch.right(r, static_cast<Index>(k));
    at += rank;
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
    append(rigid_.columns, e);
    for (Weights::InnerIterator w(weights_, e); w; ++w)
      append(corrections_.columns, static_cast<int>(w.col()));
  }
}

}  // namespace palpa::bem
