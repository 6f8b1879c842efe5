#include "bem/compressed/block_rows.h"

#include <algorithm>

namespace palpa::bem {

using Eigen::Matrix3d;

BlockRow mergedRow(BlockRowEntries& entries) {
  std::stable_sort(entries.begin(), entries.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  BlockRow row;
  for (std::size_t k = 0; k < entries.size();) {
    const int column = entries[k].first;
    Matrix3d sum = Matrix3d::Zero();
    for (; k < entries.size() && entries[k].first == column; ++k) sum += entries[k].second;
    row.columns.push_back(column);
    auto& block = row.blocks.emplace_back();
    for (int i = 0; i < 3; ++i)
      for (int c = 0; c < 3; ++c) block[3 * i + c] = static_cast<float>(sum(i, c));
  }
  row.columns.shrink_to_fit();
  row.blocks.shrink_to_fit();
  return row;
}

BlockRows joined(std::vector<BlockRow> rows) {
  BlockRows result;
  result.begin.push_back(0);
  for (const BlockRow& row : rows) result.begin.push_back(result.begin.back() + row.columns.size());
  result.columns.reserve(result.begin.back());
  result.blocks.reserve(result.begin.back());
  for (BlockRow& row : rows) {
    result.columns.insert(result.columns.end(), row.columns.begin(), row.columns.end());
    result.blocks.insert(result.blocks.end(), row.blocks.begin(), row.blocks.end());
    row = {};
  }
  return result;
}

}  // namespace palpa::bem
