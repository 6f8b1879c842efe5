#pragma once

#include <bit>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "bem/linalg/unpack_groups.h"

namespace palpa::bem::detail {

/// Vectors of the compiler: it unrolls plain loops over a group before it sees that they could be
/// vectors. `Arch` gives each instruction set a function.
template <class Arch>
void unpackGroups(const UnpackGroupsTask& task) {
  constexpr std::size_t kGroup = 16;
  constexpr int kMantissaBits = 23, kMore = 1 << 8;
  using Digits [[gnu::vector_size(kGroup * sizeof(std::int16_t))]] = std::int16_t;
  using MoreDigits [[gnu::vector_size(kGroup)]] = std::uint8_t;
  using FewDigits [[gnu::vector_size(kGroup)]] = std::int8_t;
  using Whole [[gnu::vector_size(kGroup * sizeof(std::int32_t))]] = std::int32_t;
  using Numbers [[gnu::vector_size(kGroup * sizeof(float))]] = float;
  for (std::size_t group = 0; group < task.groups; ++group) {
    const auto scale =
        std::bit_cast<float>(static_cast<std::uint32_t>(task.exponents[group]) << kMantissaBits);
    Numbers numbers;
    // Bytes become numbers in two steps: GCC 12 converts 8 to 32 bits one by one.
    if (!task.digits) {
      FewDigits few;
      __builtin_memcpy(&few, task.moreDigits + kGroup * group, sizeof(few));
      const Whole whole = __builtin_convertvector(__builtin_convertvector(few, Digits), Whole);
      numbers = scale * kMore * __builtin_convertvector(whole, Numbers);
    } else {
      Digits digits;
      __builtin_memcpy(&digits, task.digits + kGroup * group, sizeof(digits));
      Whole whole = __builtin_convertvector(digits, Whole);
      if (task.moreDigits) {
        MoreDigits more;
        __builtin_memcpy(&more, task.moreDigits + kGroup * group, sizeof(more));
        const Digits wider = __builtin_convertvector(more, Digits);
        whole = kMore * whole + __builtin_convertvector(wider, Whole);
        numbers = scale / kMore * __builtin_convertvector(whole, Numbers);
      } else {
        numbers = scale * __builtin_convertvector(whole, Numbers);
      }
    }
    __builtin_memcpy(task.to + kGroup * group, &numbers, sizeof(numbers));
  }
}

}  // namespace palpa::bem::detail
