#pragma once

#include <cstddef>
#include <type_traits>
#include <xsimd/xsimd.hpp>

namespace palpa::bem::detail {

/// Stores batches so that the values of each lane are contiguous: out[lane * kCount + k] =
/// batch[k][lane]. `out` is aligned to the size of a batch; kCount is a multiple of the number of
/// lanes.
template <class Batch, std::size_t kCount>
[[gnu::always_inline]] inline void storeTransposed(const Batch (&batch)[kCount], double* out) {
  constexpr std::size_t kLanes = Batch::size;
  static_assert(kCount % kLanes == 0);
#ifdef __AVX512F__
  if constexpr (std::is_same_v<Batch, xsimd::batch<double, xsimd::avx512f>>) {
    for (std::size_t k = 0; k < kCount; k += 8) {
      __m512d pair[8];  // lanes 0 2 4 6 and 1 3 5 7 of two batches
      for (int i = 0; i < 8; i += 2) {
        pair[i] = _mm512_unpacklo_pd(batch[k + i], batch[k + i + 1]);
        pair[i + 1] = _mm512_unpackhi_pd(batch[k + i], batch[k + i + 1]);
      }
      for (int odd = 0; odd < 2; ++odd) {
        const __m512d lower0 = _mm512_shuffle_f64x2(pair[odd], pair[2 + odd], 0x44),
                      upper0 = _mm512_shuffle_f64x2(pair[odd], pair[2 + odd], 0xEE),
                      lower1 = _mm512_shuffle_f64x2(pair[4 + odd], pair[6 + odd], 0x44),
                      upper1 = _mm512_shuffle_f64x2(pair[4 + odd], pair[6 + odd], 0xEE);
        double* at = out + odd * kCount + k;
        _mm512_store_pd(at, _mm512_shuffle_f64x2(lower0, lower1, 0x88));
        _mm512_store_pd(at + 2 * kCount, _mm512_shuffle_f64x2(lower0, lower1, 0xDD));
        _mm512_store_pd(at + 4 * kCount, _mm512_shuffle_f64x2(upper0, upper1, 0x88));
        _mm512_store_pd(at + 6 * kCount, _mm512_shuffle_f64x2(upper0, upper1, 0xDD));
      }
    }
    return;
  }
#endif
#ifdef __AVX2__
  if constexpr (std::is_same_v<Batch, xsimd::batch<double, xsimd::fma3<xsimd::avx2>>>) {
    for (std::size_t k = 0; k < kCount; k += 4) {
      const __m256d low0 = _mm256_unpacklo_pd(batch[k], batch[k + 1]),
                    high0 = _mm256_unpackhi_pd(batch[k], batch[k + 1]),
                    low1 = _mm256_unpacklo_pd(batch[k + 2], batch[k + 3]),
                    high1 = _mm256_unpackhi_pd(batch[k + 2], batch[k + 3]);
      _mm256_store_pd(out + k, _mm256_permute2f128_pd(low0, low1, 0x20));
      _mm256_store_pd(out + kCount + k, _mm256_permute2f128_pd(high0, high1, 0x20));
      _mm256_store_pd(out + 2 * kCount + k, _mm256_permute2f128_pd(low0, low1, 0x31));
      _mm256_store_pd(out + 3 * kCount + k, _mm256_permute2f128_pd(high0, high1, 0x31));
    }
    return;
  }
#endif
  alignas(64) double lanes[kLanes];
  for (std::size_t k = 0; k < kCount; ++k) {
    batch[k].store_aligned(lanes);
    for (std::size_t lane = 0; lane < kLanes; ++lane) out[lane * kCount + k] = lanes[lane];
  }
}

}  // namespace palpa::bem::detail
