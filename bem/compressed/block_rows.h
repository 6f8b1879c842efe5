#pragma once

#include <Eigen/Dense>
#include <array>
#include <utility>
#include <vector>

namespace palpa::bem {

/// Sparse matrix of 3 x 3 blocks, row after row.
struct BlockRows {
  std::vector<std::size_t> begin;            ///< of each row, and the end
  std::vector<int> columns;                  ///< ascending in each row
  std::vector<std::array<float, 9>> blocks;  ///< [3 i + c]
  std::size_t bytes() const {
    return begin.size() * sizeof(std::size_t) + columns.size() * sizeof(int) +
           blocks.size() * sizeof(blocks[0]);
  }
};

/// Blocks of one row in any order, with their columns.
using BlockRowEntries = std::vector<std::pair<int, Eigen::Matrix3d>>;
/// One row: columns ascend, blocks of one column are added.
struct BlockRow {
  std::vector<int> columns;
  std::vector<std::array<float, 9>> blocks;
};
/// Sorts the entries.
BlockRow mergedRow(BlockRowEntries& entries);
BlockRows joined(std::vector<BlockRow> rows);

}  // namespace palpa::bem
