#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "bem/compressed/block_columns.h"
#include "bem/compressed/packed_block.h"

namespace palpa::bem {

/// [3 i + c]
using BlockNumbers = std::array<float, 9>;

/// A block within 2^-15 of its largest number. If a number is not finite, none is afterwards.
PackedBlock packed(const BlockNumbers& numbers);
/// The same of the symmetric part.
PackedSymmetricBlock packedSymmetric(const BlockNumbers& numbers);
inline BlockNumbers numbersOf(const PackedBlock& block) {
  const float scale = block.scaleFactor();
  BlockNumbers numbers;
  for (std::size_t k = 0; k < numbers.size(); ++k)
    numbers[k] = scale * static_cast<float>(block.digits[k]);
  return numbers;
}
inline BlockNumbers numbersOf(const PackedSymmetricBlock& block) {
  const auto& d = block.digits;
  return numbersOf(
      PackedBlock{{d[0], d[1], d[2], d[1], d[3], d[4], d[2], d[4], d[5]}, block.scale});
}

/// Sparse matrix of 3 x 3 blocks.
template <class Block>
struct BlockRows {
  BlockColumns columns;
  std::vector<Block> blocks;
  std::size_t bytes() const { return columns.bytes() + blocks.size() * sizeof(Block); }
};

/// Packs blocks. The last one of `to`, one more than `blocks`, gets what this changes in the sum of
/// the blocks. In the column of the largest of these, whose index is returned, it leaves the
/// product with a field of equal vectors as it was.
std::size_t packRow(std::span<const BlockNumbers> blocks, std::span<PackedBlock> to);

/// Blocks of one row in any order, with their columns.
using BlockRowEntries = std::vector<std::pair<int, Eigen::Matrix3d>>;
/// One row.
struct BlockRow {
  std::vector<int> columns;
  std::vector<PackedBlock> blocks;
};
/// Sorts the entries: columns ascend, blocks of one column are added.
BlockRow mergedRow(BlockRowEntries& entries);
BlockRows<PackedBlock> joined(std::vector<BlockRow> rows);

}  // namespace palpa::bem
