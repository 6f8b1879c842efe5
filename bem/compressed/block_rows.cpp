#include "bem/compressed/block_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "bem/linalg/packed_numbers.h"

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
    BlockNumbers numbers;
    for (int i = 0; i < 3; ++i)
      for (int c = 0; c < 3; ++c) numbers[3 * i + c] = static_cast<float>(sum(i, c));
    row.blocks.push_back(packed(numbers));
  }
  row.columns.shrink_to_fit();
  row.blocks.shrink_to_fit();
  return row;
}

BlockRows<PackedBlock> joined(std::vector<BlockRow> rows) {
  BlockRows<PackedBlock> result;
  result.columns.reserve(rows.size());
  std::size_t count = 0;
  for (const BlockRow& row : rows) count += row.blocks.size();
  result.blocks.reserve(count);
  for (BlockRow& row : rows) {
    result.columns.appendRow(row.columns);
    result.blocks.insert(result.blocks.end(), row.blocks.begin(), row.blocks.end());
    row = {};
  }
  result.columns.shrink();
  return result;
}

namespace {

template <std::size_t kCount>
PackedNumbersOfBlock<kCount> packedNumbers(const std::array<float, kCount>& numbers) {
  constexpr float kMaxDigits = std::numeric_limits<std::int16_t>::max();
  PackedNumbersOfBlock<kCount> block;
  const float largest = largestMagnitude(numbers);
  if (largest == 0) return block;
  if (!std::isfinite(largest)) {
    block.scale = std::numeric_limits<std::uint16_t>::max();  // not a number
    return block;
  }
  // The next larger one of the scales.
  block.scale = static_cast<std::uint16_t>(
      (std::bit_cast<std::uint32_t>(largest / kMaxDigits) >> PackedBlock::kLowerHalf) + 1);
  const float scale = block.scaleFactor();
  for (std::size_t k = 0; k < kCount; ++k)
    block.digits[k] = static_cast<std::int16_t>(std::nearbyint(numbers[k] / scale));
  return block;
}

}  // namespace

PackedBlock packed(const BlockNumbers& numbers) {
  return packedNumbers(numbers);
}

PackedSymmetricBlock packedSymmetric(const BlockNumbers& n) {
  return packedNumbers(
      std::array{n[0], (n[1] + n[3]) / 2, (n[2] + n[6]) / 2, n[4], (n[5] + n[7]) / 2, n[8]});
}

std::size_t packRow(std::span<const BlockNumbers> blocks, std::span<PackedBlock> to) {
  std::array<double, 9> change{};
  std::size_t most = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    to[b] = packed(blocks[b]);
    if (largestMagnitude(blocks[b]) > largestMagnitude(blocks[most])) most = b;
    const BlockNumbers rounded = numbersOf(to[b]);
    for (int k = 0; k < 9; ++k)
      change[k] += static_cast<double>(blocks[b][k]) - static_cast<double>(rounded[k]);
  }
  BlockNumbers numbers{};
  for (int k = 0; k < 9; ++k) numbers[k] = static_cast<float>(change[k]);
  to.back() = packed(numbers);
  return most;
}

}  // namespace palpa::bem
