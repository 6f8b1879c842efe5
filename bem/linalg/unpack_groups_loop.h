#pragma once

#include <bit>
#include <xsimd/xsimd.hpp>

#include "bem/linalg/unpack_groups.h"

namespace palpa::bem::detail {

/// Plain loops that the compiler translates for the instruction set of the file; `Arch` gives each
/// set a function.
template <class Arch>
void unpackGroups(const UnpackGroupsTask& task) {
  constexpr std::size_t kGroup = 16;
  constexpr int kMantissaBits = 23, kMore = 1 << 8;
  for (std::size_t group = 0; group < task.groups; ++group) {
    const auto scale =
        std::bit_cast<float>(static_cast<std::uint32_t>(task.exponents[group]) << kMantissaBits);
    const std::int16_t* digits = task.digits + kGroup * group;
    float* to = task.to + kGroup * group;
    if (!task.moreDigits) {
      for (std::size_t k = 0; k < kGroup; ++k) to[k] = scale * static_cast<float>(digits[k]);
      continue;
    }
    const std::uint8_t* more = task.moreDigits + kGroup * group;
    for (std::size_t k = 0; k < kGroup; ++k)
      to[k] = scale / kMore * static_cast<float>(kMore * digits[k] + more[k]);
  }
}

}  // namespace palpa::bem::detail
