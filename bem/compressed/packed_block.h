#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace palpa::bem {

/// A block of 3 x 3 numbers in 20 bytes: digits times a scale.
struct PackedBlock {
  std::array<std::int16_t, 9> digits{};  ///< [3 i + c]
  std::uint16_t scale = 0;               ///< upper half of the bits of a number of single precision
  static constexpr int kLowerHalf = 16;  ///< bits
  float scaleFactor() const {
    return std::bit_cast<float>(static_cast<std::uint32_t>(scale) << kLowerHalf);
  }
};

}  // namespace palpa::bem
