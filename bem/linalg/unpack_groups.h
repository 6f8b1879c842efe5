#pragma once

#include <cstddef>
#include <cstdint>

/// The loop that reads PackedNumbers, compiled once per instruction set.
namespace palpa::bem {

struct UnpackGroupsTask {
  const std::int16_t* digits;      ///< [group][PackedNumbers::kGroup], or null
  const std::uint8_t* moreDigits;  ///< that follow these, or null; signed ones without these
  const std::uint8_t* exponents;   ///< [group]
  std::size_t groups;
  float* to;  ///< [group][PackedNumbers::kGroup]
};

void unpackGroupsBaseline(const UnpackGroupsTask&);
void unpackGroupsAvx2(const UnpackGroupsTask&);
void unpackGroupsAvx512(const UnpackGroupsTask&);

using UnpackGroups = void (*)(const UnpackGroupsTask&);
/// Fastest variant that this processor supports.
UnpackGroups unpackGroupsForThisProcessor();

}  // namespace palpa::bem
