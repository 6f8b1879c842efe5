#pragma once

#include <bit>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "bem/compressed/block_products.h"

namespace palpa::bem::detail {

using EightDigits [[gnu::vector_size(8 * sizeof(std::int16_t))]] = std::int16_t;
using EightNumbers [[gnu::vector_size(8 * sizeof(float))]] = float;
template <int kLanes>
struct LanesOf {
  using Type [[gnu::vector_size(kLanes * sizeof(float))]] = float;
};

/// Right-hand sides `first`, …, `first + kept - 1`, at most kLanes. Vectors of the compiler instead
/// of a library's: `Arch` alone gives each instruction set a function.
template <class Arch, int kLanes>
void addBlockProduct(const BlockProductTask& task, std::ptrdiff_t first, std::ptrdiff_t kept) {
  using Lanes = typename LanesOf<kLanes>::Type;
  Lanes sum0{}, sum1{}, sum2{};
  for (std::size_t b = 0; b < task.count; ++b) {
    const std::ptrdiff_t column = task.columns[b];
    if (task.isLoaded && !task.isLoaded[column]) continue;
    const PackedBlock& block = task.blocks[b];
    const std::int16_t* digits = &block.digits[0];
    // As PackedBlock::scaleFactor(), which must not get a version for one instruction set.
    const auto scale =
        std::bit_cast<float>(static_cast<std::uint32_t>(block.scale) << PackedBlock::kLowerHalf);
    float factors[9];
    EightDigits eightDigits;
    __builtin_memcpy(&eightDigits, digits, sizeof(eightDigits));
    const EightNumbers eight = scale * __builtin_convertvector(eightDigits, EightNumbers);
    __builtin_memcpy(factors, &eight, sizeof(eight));
    factors[8] = scale * static_cast<float>(digits[8]);
    const float* at = task.x + 3 * column * task.width + first;
    Lanes x0, x1, x2;
    __builtin_memcpy(&x0, at, sizeof(Lanes));
    __builtin_memcpy(&x1, at + task.width, sizeof(Lanes));
    __builtin_memcpy(&x2, at + 2 * task.width, sizeof(Lanes));
    sum0 += factors[0] * x0 + factors[1] * x1 + factors[2] * x2;
    sum1 += factors[3] * x0 + factors[4] * x1 + factors[5] * x2;
    sum2 += factors[6] * x0 + factors[7] * x1 + factors[8] * x2;
  }
  float* y = task.y + first;
  for (std::ptrdiff_t k = 0; k < kept; ++k) {
    y[k] += sum0[k];
    y[task.width + k] += sum1[k];
    y[2 * task.width + k] += sum2[k];
  }
}

template <class Arch>
void addBlockProduct(const BlockProductTask& task) {
  constexpr int kMany = 16, kFew = 4;
  static_assert(kFew == BlockProductTask::kRead + 1);
  std::ptrdiff_t first = 0;
  for (; first + kMany <= task.width; first += kMany)
    addBlockProduct<Arch, kMany>(task, first, kMany);
  for (; first < task.width; first += kFew)
    addBlockProduct<Arch, kFew>(task, first, task.width - first < kFew ? task.width - first : kFew);
}

}  // namespace palpa::bem::detail
