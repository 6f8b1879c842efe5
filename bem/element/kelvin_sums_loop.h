#pragma once

#include <algorithm>
#include <type_traits>
#include <xsimd/xsimd.hpp>

#include "bem/base/inverse_square_root.h"
#include "bem/element/kelvin_blocks.h"
#include "bem/element/kelvin_sums.h"
#include "bem/element/transpose.h"

/// Loops of kelvin_sums.h, included by one source file per instruction set.
namespace palpa::bem::detail {

/// Kelvin's kernels times the weights at some points of the task, one point per lane.
template <class Batch>
[[gnu::always_inline]] inline void evaluateKernels(const SumKernelsTask& task, int first,
                                                   Batch (&kernel)[kKernelStride]) {
  constexpr int kRow[6] = {0, 0, 1, 0, 1, 2}, kColumn[6] = {0, 1, 1, 2, 2, 2};
  const auto count = static_cast<std::ptrdiff_t>(task.count);
  const double* geometry = task.geometry + first;
  Batch r[3], n[3];
  for (int c = 0; c < 3; ++c) {
    r[c] = Batch::load_unaligned(geometry + c * count) - Batch(task.x[c]);
    n[c] = Batch::load_unaligned(geometry + (3 + c) * count);
  }
  const Batch inverse =
      inverseSquareRoot(xsimd::fma(r[0], r[0], xsimd::fma(r[1], r[1], r[2] * r[2])));
  const Batch inverseSquared = inverse * inverse, inverseCubed = inverse * inverseSquared;
  const Batch along = xsimd::fma(r[0], n[0], xsimd::fma(r[1], n[1], r[2] * n[2]));
  const Batch weightU = Batch::load_unaligned(geometry + 6 * count) * inverseCubed;
  const Batch weightT = along * inverseCubed * inverseSquared;
  for (int k = 0; k < 6; ++k) {
    const Batch product = r[kRow[k]] * r[kColumn[k]];
    kernel[k] = weightU * product;
    kernel[6 + k] = weightT * product;
  }
  for (int c = 0; c < 3; ++c) {
    const int d = (c + 1) % 3, e = (c + 2) % 3;
    kernel[12 + c] = inverseCubed * (r[d] * n[e] - r[e] * n[d]);
  }
  kernel[15] = Batch(0.0);
}

/// out[f] += Σ_k weights[k][f] in[k] for `Size` functions f; `in` and `out` are KernelSums with the
/// given strides. Without kAdd, out is overwritten.
template <class Batch, int Size, bool kAdd>
[[gnu::always_inline]] inline void contract(const KernelSums* in, int inStep, int count,
                                            const double* weights, std::ptrdiff_t weightStride,
                                            KernelSums* out, int outStep) {
  constexpr int kLanes = static_cast<int>(Batch::size);
  for (int lane = 0; lane < kKernelStride; lane += 2 * kLanes) {  // sums that fit into registers
    Batch sum[Size][2];
    for (int f = 0; f < Size; ++f)
      for (int h = 0; h < 2; ++h)
        sum[f][h] =
            kAdd ? Batch::load_aligned(out[f * outStep].of + lane + h * kLanes) : Batch(0.0);
    for (int k = 0; k < count; ++k) {
      const double* values = in[k * inStep].of + lane;
      const Batch a = Batch::load_aligned(values), b = Batch::load_aligned(values + kLanes);
      for (int f = 0; f < Size; ++f) {
        const Batch weight(weights[k * weightStride + f]);
        sum[f][0] = xsimd::fma(weight, a, sum[f][0]);
        sum[f][1] = xsimd::fma(weight, b, sum[f][1]);
      }
    }
    for (int f = 0; f < Size; ++f)
      for (int h = 0; h < 2; ++h) sum[f][h].store_aligned(out[f * outStep].of + lane + h * kLanes);
  }
}

/// Calls body(std::integral_constant<int, size>) for a size in 1 … kMaxFunctionsAlong.
template <class Body>
void withSize(int size, const Body& body) {
  static_assert(kMaxFunctionsAlong == 6);
  switch (size) {
    case 1:
      return body(std::integral_constant<int, 1>{});
    case 2:
      return body(std::integral_constant<int, 2>{});
    case 3:
      return body(std::integral_constant<int, 3>{});
    case 4:
      return body(std::integral_constant<int, 4>{});
    case 5:
      return body(std::integral_constant<int, 5>{});
    default:
      return body(std::integral_constant<int, 6>{});
  }
}

template <class Arch>
void sumKernels(const SumKernelsTask& task) {
  using Batch = xsimd::batch<double, Arch>;
  constexpr int kLanes = static_cast<int>(Batch::size);
  constexpr int kMaxPoints =
      kElementLanes * kElementLanes;  // of a tensor rule, and processed at a time
  constexpr int kMaxSize = kMaxFunctionsAlong;
  KernelSums kernels[kMaxPoints];
  const auto evaluate = [&](int begin, int end) {
    for (int first = begin; first < end; first += kLanes) {
      Batch kernel[kKernelStride];
      evaluateKernels(task, first, kernel);
      storeTransposed(kernel, kernels[first - begin].of);
    }
  };
  const int n = task.perDirection;
  if (n > 0) {
    // The functions are products, so the sums factorise: along u first, row by row, then along v.
    evaluate(0, task.count);
    KernelSums rows[kElementLanes * kMaxSize];
    const int inU = task.functions[0];
    withSize(inU, [&](auto size) {
      for (int j = 0; j < n; ++j)
        contract<Batch, size(), false>(kernels + j * n, 1, n, task.basis[0], size(),
                                       rows + j * size(), 1);
    });
    withSize(task.functions[1], [&](auto size) {
      for (int i = 0; i < inU; ++i)
        contract<Batch, size(), true>(rows + i, inU, n, task.basis[1], size(), task.sums + i, inU);
    });
    return;
  }
  for (int begin = 0; begin < task.used; begin += kMaxPoints) {
    evaluate(begin, std::min(task.count, begin + kMaxPoints));
    const int points = std::min(task.used - begin, kMaxPoints);
    const double* basis = task.basis[0] + static_cast<std::ptrdiff_t>(begin) * task.functionStride;
    for (int f = 0; f < task.functions[0]; f += kMaxSize)
      withSize(std::min(task.functions[0] - f, kMaxSize), [&](auto size) {
        contract<Batch, size(), true>(kernels, 1, points, basis + f, task.functionStride,
                                      task.sums + f, 1);
      });
  }
}

template <class Arch>
void addSums(const AddSumsTask& task) {
  using Batch = xsimd::batch<double, Arch>;
  constexpr int kLanes = static_cast<int>(Batch::size);
  const auto add = [](const double* from, int count, double* to) {
    int k = 0;
    for (; k + kLanes <= count; k += kLanes)
      (Batch::load_unaligned(to + k) + Batch::load_unaligned(from + k)).store_unaligned(to + k);
    for (; k < count; ++k) to[k] += from[k];
  };
  for (int f = 0; f < task.functions; ++f) {
    const double* sums = task.sums[f].of;
    add(sums, kKernelSumsU, task.U + static_cast<std::ptrdiff_t>(kKernelSumsU) * task.slots[f]);
    add(sums + kKernelSumsU, kKernelSumsT,
        task.T + static_cast<std::ptrdiff_t>(kKernelSumsT) * task.coefficients[f]);
  }
}

template <class Arch, class Block>
void makeBlocks(const MakeBlocksTask& task) {
  using Batch = xsimd::batch<double, Arch>;
  constexpr int kLanes = static_cast<int>(Batch::size), kSums = Block::kSums;
  // [sum][point].
  alignas(64) double sums[roundUpToLanes(kSums)][kElementLanes];
  for (int j = 0; j < task.count; ++j) {
    const auto at = static_cast<std::ptrdiff_t>(kSums) * task.coefficients[j];
    int s = 0;
    for (; s < std::min(kSums, kElementLanes); s += kLanes) {
      Batch ofPoint[kElementLanes];
      for (int k = 0; k < kElementLanes; ++k)
        ofPoint[k] = Batch::load_unaligned(task.sums[k] + at + s);
      storeTransposed(ofPoint, sums[s]);
    }
    for (; s < kSums; ++s)
      for (int k = 0; k < kElementLanes; ++k) sums[s][k] = task.sums[k][at + s];
    double* block = task.blocks + static_cast<std::ptrdiff_t>(9 * kElementLanes) * j;
    for (int k = 0; k < kElementLanes; k += kLanes) {
      Batch sum[kSums];
      for (int m = 0; m < kSums; ++m) sum[m] = Batch::load_aligned(sums[m] + k);
      for (int c = 0; c < 3; ++c)
        for (int i = 0; i < 3; ++i)
          Block::template component<Batch>(task.constants, sum, i, c)
              .store_aligned(block + (3 * c + i) * kElementLanes + k);
    }
  }
}

}  // namespace palpa::bem::detail
