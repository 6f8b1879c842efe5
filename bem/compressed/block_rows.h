#pragma once

#include <Eigen/Dense>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "bem/compressed/packed_block.h"

namespace palpa::bem {

/// [3 i + c]
using BlockNumbers = std::array<float, 9>;

/// A block within 2^-15 of its largest number. If a number is not finite, none is afterwards.
PackedBlock packed(const BlockNumbers& numbers);
inline BlockNumbers numbersOf(const PackedBlock& block) {
  const float scale = block.scaleFactor();
  BlockNumbers numbers;
  for (std::size_t k = 0; k < numbers.size(); ++k)
    numbers[k] = scale * static_cast<float>(block.digits[k]);
  return numbers;
}

/// Sparse matrix of 3 x 3 blocks, row after row. A row may have several blocks in a column.
struct BlockRows {
  std::vector<std::size_t> begin;  ///< of each row, and the end
  std::vector<int> columns;
  std::vector<PackedBlock> blocks;
  std::size_t bytes() const {
    return begin.size() * sizeof(std::size_t) + columns.size() * sizeof(int) +
           blocks.size() * sizeof(blocks[0]);
  }
};

/// Packs blocks. The last one of `to`, one more than `blocks`, gets what this changes in the sum of
/// the first `summed` blocks. In the column of the largest of these, whose index is returned, it
/// leaves the product with a field of equal vectors as it was.
std::size_t packRow(std::span<const BlockNumbers> blocks, std::size_t summed,
                    std::span<PackedBlock> to);

/// Blocks of one row in any order, with their columns.
using BlockRowEntries = std::vector<std::pair<int, Eigen::Matrix3d>>;
/// One row.
struct BlockRow {
  std::vector<int> columns;
  std::vector<PackedBlock> blocks;
};
/// Sorts the entries: columns ascend, blocks of one column are added.
BlockRow mergedRow(BlockRowEntries& entries);
BlockRows joined(std::vector<BlockRow> rows);

}  // namespace palpa::bem
