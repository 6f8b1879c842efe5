#pragma once

#include <type_traits>
#include <xsimd/xsimd.hpp>

namespace palpa::bem {

/// 1 / sqrt(x) to the last bits but one; x > 0.
template <class Batch>
inline Batch inverseSquareRoot(const Batch& x) {
#ifdef __AVX512F__
  // Two Newton steps from the processor's 14-bit estimate are several times faster than a division
  // and a square root.
  if constexpr (std::is_same_v<Batch, xsimd::batch<double, xsimd::avx512f>>) {
    const Batch half = Batch(0.5) * x;
    Batch y(_mm512_rsqrt14_pd(x));
    y = y * xsimd::fnma(half, y * y, Batch(1.5));
    return y * xsimd::fnma(half, y * y, Batch(1.5));
  }
#endif
  return Batch(1.0) / xsimd::sqrt(x);
}

}  // namespace palpa::bem
