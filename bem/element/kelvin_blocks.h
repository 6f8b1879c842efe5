#pragma once

#include "bem/element/kelvin_sums.h"

/// Components of Kelvin's blocks computed from the sums of their kernels (kelvin_sums.h), for
/// numbers and for batches of numbers.
namespace palpa::bem::detail {

inline constexpr int kPackedSum[3][3] = {{0, 1, 3}, {1, 2, 4}, {3, 4, 5}};

struct BlockU {
  static constexpr int kSums = kKernelSumsU;
  template <class Value>
  static Value component(const KelvinConstants& k, const Value* sum, int i, int c) {
    const Value value = sum[kPackedSum[i][c]];
    const Value trace = sum[0] + sum[2] + sum[5];
    return Value(k.weightU) * (i == c ? value + Value(k.diagonalU) * trace : value);
  }
};

struct BlockT {
  static constexpr int kSums = kKernelSumsT;
  template <class Value>
  static Value component(const KelvinConstants& k, const Value* sum, int i, int c) {
    const Value value = Value(3.0) * sum[kPackedSum[i][c]], diagonal(k.diagonalT);
    const Value trace = sum[0] + sum[2] + sum[5];
    if (i == c) return Value(k.weightT) * (value + diagonal * trace);
    // e_i n_j - e_j n_i is the component of r x n across i and j.
    const Value turn = diagonal * sum[6 + 3 - i - c];
    return Value(k.weightT) * ((c - i + 3) % 3 == 1 ? value - turn : value + turn);
  }
};

}  // namespace palpa::bem::detail
