#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "bem/compressed/block_products.h"

namespace palpa::bem::detail {

template <int kLanes>
struct LanesOf {
  using Type [[gnu::vector_size(kLanes * sizeof(float))]] = float;
};

/// The nine numbers of a block, [3 i + c]. `Arch` alone gives each instruction set a function, also
/// of what other files have as inline functions.
template <class Arch>
struct Factors {
  using FourDigits [[gnu::vector_size(4 * sizeof(std::int16_t))]] = std::int16_t;
  using FourNumbers [[gnu::vector_size(4 * sizeof(float))]] = float;
  using EightDigits [[gnu::vector_size(8 * sizeof(std::int16_t))]] = std::int16_t;
  using EightNumbers [[gnu::vector_size(8 * sizeof(float))]] = float;
  float of[9];

  template <std::size_t kCount>
  static float scaleOf(const PackedNumbersOfBlock<kCount>& block) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(block.scale) << PackedBlock::kLowerHalf);
  }
  explicit Factors(const PackedBlock& block) {
    const std::int16_t* digits = &block.digits[0];
    const float scale = scaleOf(block);
    EightDigits eightDigits;
    __builtin_memcpy(&eightDigits, digits, sizeof(eightDigits));
    const EightNumbers eight = scale * __builtin_convertvector(eightDigits, EightNumbers);
    __builtin_memcpy(of, &eight, sizeof(eight));
    of[8] = scale * static_cast<float>(digits[8]);
  }
  explicit Factors(const PackedSymmetricBlock& block) {
    const std::int16_t* digits = &block.digits[0];
    const float scale = scaleOf(block);
    FourDigits fourDigits;
    __builtin_memcpy(&fourDigits, digits, sizeof(fourDigits));
    const FourNumbers four = scale * __builtin_convertvector(fourDigits, FourNumbers);
    of[0] = four[0];
    of[1] = of[3] = four[1];
    of[2] = of[6] = four[2];
    of[4] = four[3];
    of[5] = of[7] = scale * static_cast<float>(digits[4]);
    of[8] = scale * static_cast<float>(digits[5]);
  }
};

/// Right-hand sides `first`, …, `first + kept - 1`, at most kLanes. Vectors of the compiler instead
/// of a library's.
template <class Arch, int kLanes, class Block>
void addBlockProduct(const BlockProductTask<Block>& task, std::ptrdiff_t first,
                     std::ptrdiff_t kept) {
  using Lanes = typename LanesOf<kLanes>::Type;
  Lanes sum0{}, sum1{}, sum2{};
  const Block* block = task.blocks;
  const ColumnRun* const end = task.runs + task.runCount;
  for (const ColumnRun* run = task.runs; run != end; ++run) {
    for (std::ptrdiff_t column = run->first; column < run->first + run->count; ++column, ++block) {
      if (task.isLoaded && !task.isLoaded[column]) continue;
      const Factors<Arch> factors(*block);
      const float* at = task.x + 3 * column * task.width + first;
      Lanes x0, x1, x2;
      __builtin_memcpy(&x0, at, sizeof(Lanes));
      __builtin_memcpy(&x1, at + task.width, sizeof(Lanes));
      __builtin_memcpy(&x2, at + 2 * task.width, sizeof(Lanes));
      sum0 += factors.of[0] * x0 + factors.of[1] * x1 + factors.of[2] * x2;
      sum1 += factors.of[3] * x0 + factors.of[4] * x1 + factors.of[5] * x2;
      sum2 += factors.of[6] * x0 + factors.of[7] * x1 + factors.of[8] * x2;
    }
  }
  float* y = task.y + first;
  for (std::ptrdiff_t k = 0; k < kept; ++k) {
    y[k] += sum0[k];
    y[task.width + k] += sum1[k];
    y[2 * task.width + k] += sum2[k];
  }
}

template <class Arch, class Block>
void addBlockProduct(const BlockProductTask<Block>& task) {
  constexpr int kMany = 16, kFew = 4;
  static_assert(kFew == kReadBehind + 1);
  std::ptrdiff_t first = 0;
  for (; first + kMany <= task.width; first += kMany)
    addBlockProduct<Arch, kMany>(task, first, kMany);
  for (; first < task.width; first += kFew)
    addBlockProduct<Arch, kFew>(task, first, task.width - first < kFew ? task.width - first : kFew);
}

}  // namespace palpa::bem::detail
