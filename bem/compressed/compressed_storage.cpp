#include <algorithm>
#include <utility>

#include "base/byte_reader.h"
#include "bem/compressed/compressed_operators.h"

namespace palpa::bem {

using Eigen::Index;

namespace {

template <class Block>
void writeRows(const BlockRows<Block>& rows, const ByteSink& sink) {
  rows.columns.write(sink);
  writeList(sink, rows.blocks);
}

template <class Block>
void readRows(BlockRows<Block>& rows, const ByteSource& source, std::size_t count,
              int columnCount) {
  rows.columns = BlockColumns::read(source, count, columnCount);
  rows.blocks = readList<Block>(source);
  if (rows.blocks.size() != rows.columns.blockCount()) throw DamagedData();
}

/// Adds rows to others, of which one has no blocks in each row.
template <class Block>
void addRows(BlockRows<Block>& to, const BlockRows<Block>& from) {
  BlockRows<Block> both;
  const std::size_t rows = to.columns.rowCount();
  both.columns.reserve(rows);
  both.blocks.reserve(to.blocks.size() + from.blocks.size());
  for (std::size_t row = 0; row < rows; ++row) {
    for (const BlockRows<Block>* some : {&std::as_const(to), &from}) {
      const auto begin =
          some->blocks.begin() + static_cast<std::ptrdiff_t>(some->columns.begin(row));
      both.blocks.insert(both.blocks.end(), begin,
                         begin + static_cast<std::ptrdiff_t>(some->columns.count(row)));
    }
    both.columns.appendRow(to.columns.runs(row), from.columns.runs(row));
  }
  to = std::move(both);
}

/// Appends blocks and restores their order: columns ascend.
template <class Block>
void append(std::vector<std::vector<Block>>& to, std::vector<std::vector<Block>>& from) {
  for (std::size_t k = 0; k < to.size(); ++k) {
    if (from[k].empty()) continue;
    std::move(from[k].begin(), from[k].end(), std::back_inserter(to[k]));
    from[k].clear();
    std::sort(to[k].begin(), to[k].end(),
              [](const Block& a, const Block& b) { return a.column < b.column; });
  }
}

}  // namespace

void CompressedOperators::add(CompressedOperators share) {
  append(far_, share.far_);
  append(near_, share.near_);
  addRows(corrections_, share.corrections_);
  addRows(averaged_.ofNodes, share.averaged_.ofNodes);
  addRows(averaged_.ofSlots, share.averaged_.ofSlots);
  addRows(rigid_, share.rigid_);
}

void CompressedOperators::write(const ByteSink& sink) const {
  bem::write(order_, sink);
  std::vector<int> sizes;
  for (const ClusterBasis& basis : bases_) sizes.push_back(basis.size());
  writeList(sink, sizes);
  for (const ClusterBasis& basis : bases_) {
    basis.ofNodes.write(sink);
    basis.ofSlots.write(sink);
  }
  for (const auto& blocks : far_) {
    std::vector<int> heads;
    for (const FarBlock& block : blocks) {
      heads.push_back(block.column);
      heads.push_back(block.rank());
      heads.push_back(block.isCombined() ? 1 : 0);
    }
    writeList(sink, heads);
    for (const FarBlock& block : blocks) {
      block.U.write(sink);
      if (block.isCombined()) {
        block.coefficients.write(sink);
      } else {
        block.ofNodes.write(sink);
        block.ofSlots.write(sink);
      }
    }
  }
  for (const auto& blocks : near_) {
    std::vector<int> columns;
    for (const NearBlock& block : blocks) columns.push_back(block.column);
    writeList(sink, columns);
    for (const NearBlock& block : blocks) block.K.write(sink);
  }
  std::vector<int> rows, columns;
  std::vector<float> values;
  for (Index row = 0; row < weights_.rows(); ++row)
    for (decltype(weights_)::InnerIterator w(weights_, row); w; ++w) {
      rows.push_back(static_cast<int>(w.row()));
      columns.push_back(static_cast<int>(w.col()));
      values.push_back(w.value());
    }
  writeCount(sink, static_cast<std::size_t>(weights_.rows()));
  writeList(sink, rows);
  writeList(sink, columns);
  writeList(sink, values);
  writeRows(corrections_, sink);
  writeRows(averaged_.ofNodes, sink);
  writeRows(averaged_.ofSlots, sink);
  writeRows(rigid_, sink);
}

CompressedOperators::CompressedOperators(const ByteSource& source)
    : order_(readCompressedOrder(source)) {
  const ClusterTree& tree = order_.tree;
  const auto checkCluster = [&](int cluster) {
    if (cluster < 0 || cluster >= tree.count()) throw DamagedData();
  };
  const std::vector<int> sizes = readList<int>(source);
  if (sizes.size() != static_cast<std::size_t>(tree.count())) throw DamagedData();
  bases_.resize(sizes.size());
  for (int c = 0; c < tree.count(); ++c) {
    if (sizes[c] < 0 || sizes[c] > order_.columns(c)) throw DamagedData();
    bases_[c].ofNodes = GradedRows::read(sizes[c], order_.nodeColumns(c), source);
    bases_[c].ofSlots = GradedRows::read(sizes[c], order_.slotColumns(c), source);
  }
  far_.resize(static_cast<std::size_t>(tree.count()));
  for (int c = 0; c < tree.count(); ++c) {
    const std::vector<int> heads = readList<int>(source);
    if (heads.size() % 3 != 0) throw DamagedData();
    for (std::size_t k = 0; k < heads.size(); k += 3) {
      checkCluster(heads[k]);
      const int rank = heads[k + 1];
      if (rank < 0 || rank > std::max(order_.rows(c), order_.columns(heads[k])))
        throw DamagedData();
      far_[c].push_back({heads[k], {}});
    }
    for (std::size_t k = 0; k < far_[c].size(); ++k) {
      FarBlock& block = far_[c][k];
      const int rank = heads[3 * k + 1];
      block.U = GradedRows::read(rank, order_.rows(c), source);
      if (heads[3 * k + 2] != 0) {
        const int size = bases_[block.column].size();
        if (size == 0) throw DamagedData();
        block.coefficients = GradedRows::read(rank, size, source);
      } else {
        block.ofNodes = GradedRows::read(rank, order_.nodeColumns(block.column), source);
        block.ofSlots = GradedRows::read(rank, order_.slotColumns(block.column), source);
      }
    }
  }
  const int firstLeaf = ClusterTree::firstOf(tree.levelCount() - 1);
  near_.resize(static_cast<std::size_t>(tree.count() - firstLeaf));
  for (int leaf = firstLeaf; leaf < tree.count(); ++leaf) {
    auto& blocks = near_[leaf - firstLeaf];
    for (const int column : readList<int>(source)) {
      checkCluster(column);
      blocks.push_back({column, {}});
    }
    for (NearBlock& block : blocks) {
      block.K = PackedNumbers::read(static_cast<std::size_t>(order_.rows(leaf)) *
                                        static_cast<std::size_t>(order_.columns(block.column)),
                                    PackedNumbers::Bits::k16, source);
    }
  }
  readWeights(source);
  const auto equations = static_cast<std::size_t>(equationCount());
  const int nodes = nodeCount(), all = nodes + static_cast<int>(order_.slots.size());
  readRows(corrections_, source, order_.points.size(), all);
  readRows(averaged_.ofNodes, source, equations, nodes);
  readRows(averaged_.ofSlots, source, equations, all);
  readRows(rigid_, source, equations, nodes);
}

void CompressedOperators::readWeights(const ByteSource& source) {
  const std::size_t equations = readCount(source, 3 * order_.points.size() + 1);
  const std::vector<int> rows = readList<int>(source), columns = readList<int>(source);
  const std::vector<float> values = readList<float>(source);
  if (columns.size() != rows.size() || values.size() != rows.size()) throw DamagedData();
  std::vector<Eigen::Triplet<float>> weights;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k] < 0 || rows[k] >= static_cast<int>(equations) || columns[k] < 0 ||
        columns[k] >= static_cast<int>(order_.points.size()))
      throw DamagedData();
    weights.emplace_back(rows[k], columns[k], values[k]);
  }
  weights_.resize(static_cast<Index>(equations), static_cast<Index>(order_.points.size()));
  weights_.setFromTriplets(weights.begin(), weights.end());
}

bool CompressedOperators::reaches(std::span<const int> equations) const {
  const auto hasRow = [](const BlockColumns& columns, int row) {
    return columns.count(static_cast<std::size_t>(row)) > 0;
  };
  const auto hasPoint = [&](int point) {
    if (hasRow(corrections_.columns, point)) return true;
    const auto after = std::upper_bound(order_.firstPoint.begin(), order_.firstPoint.end(), point);
    int cluster = order_.tree.leafOf(static_cast<int>(after - order_.firstPoint.begin()) - 1);
    if (!near_[cluster - ClusterTree::firstOf(order_.tree.levelCount() - 1)].empty()) return true;
    for (;; cluster = (cluster - 1) / 2) {
      if (!far_[cluster].empty()) return true;
      if (cluster == 0) return false;
    }
  };
  for (const int e : equations) {
    if (hasRow(averaged_.ofNodes.columns, e) || hasRow(averaged_.ofSlots.columns, e) ||
        hasRow(rigid_.columns, e))
      return true;
    for (decltype(weights_)::InnerIterator w(weights_, e); w; ++w)
      if (hasPoint(static_cast<int>(w.col()))) return true;
  }
  return false;
}

CompressedOperators::Sizes CompressedOperators::sizes() const {
  Sizes sizes;
  for (const auto& blocks : far_)
    for (const FarBlock& block : blocks) {
      sizes.far += block.bytes();
      sizes.meanRank += block.rank();
      ++sizes.farBlocks;
    }
  for (const ClusterBasis& basis : bases_) {
    sizes.far += basis.bytes();
    if (basis.size() > 0) ++sizes.bases;
  }
  if (sizes.farBlocks > 0) sizes.meanRank /= sizes.farBlocks;
  for (const auto& blocks : near_)
    for (const NearBlock& block : blocks) sizes.near += block.K.bytes();
  sizes.averaged = averaged_.bytes() + corrections_.bytes() + rigid_.bytes();
  return sizes;
}

std::size_t CompressedOperators::bytes() const {
  const Sizes all = sizes();
  const std::size_t ofOrder =
      2 * (order_.tree.order().size() + order_.slots.size() + order_.points.size()) * sizeof(int);
  const auto ofWeights = static_cast<std::size_t>(weights_.nonZeros()) * (sizeof(float) + 4);
  return all.far + all.near + all.averaged + ofOrder + ofWeights;
}

}  // namespace palpa::bem
