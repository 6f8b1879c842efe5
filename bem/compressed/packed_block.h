#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace palpa::bem {

/// Numbers of a block of 3 x 3: digits times a scale.
template <std::size_t kCount>
struct PackedNumbersOfBlock {
  std::array<std::int16_t, kCount> digits{};
  std::uint16_t scale = 0;               ///< upper half of the bits of a number of single precision
  static constexpr int kLowerHalf = 16;  ///< bits
  float scaleFactor() const {
    return std::bit_cast<float>(static_cast<std::uint32_t>(scale) << kLowerHalf);
  }
};
/// In 20 bytes, digits [3 i + c].
using PackedBlock = PackedNumbersOfBlock<9>;
/// In 14 bytes, the upper triangle by rows: xx, xy, xz, yy, yz, zz.
using PackedSymmetricBlock = PackedNumbersOfBlock<6>;

/// Columns that follow each other, in 4 bytes.
struct ColumnRun {
  static constexpr int kMaxColumns = 1 << 24;  ///< a model with as many needs 500 GB
  static constexpr int kMaxCount = 255;
  std::uint32_t first : 24, count : 8;
};

}  // namespace palpa::bem
