#include "bench/processor_peak.h"

#include <algorithm>
#include <thread>
#include <vector>

#include "bem/base/instruction_set.h"
#include "bench/timing.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace palpa::bench {
namespace {

constexpr long kRounds = 20'000'000;
constexpr int kChains = 12;  // of dependent operations: more than latency times units

#if defined(__x86_64__)
[[gnu::target("avx512f")]] double multiplyAdd512() {
  __m512d sums[kChains];
  for (int k = 0; k < kChains; ++k) sums[k] = _mm512_set1_pd(k);
  const __m512d factor = _mm512_set1_pd(0.999999), step = _mm512_set1_pd(1e-9);
  for (long round = 0; round < kRounds; ++round)
    for (auto& sum : sums) sum = _mm512_fmadd_pd(sum, factor, step);
  __m512d total = sums[0];
  for (int k = 1; k < kChains; ++k) total = _mm512_add_pd(total, sums[k]);
  alignas(64) double lanes[8];
  _mm512_store_pd(lanes, total);
  return lanes[0];
}

[[gnu::target("avx2,fma")]] double multiplyAdd256() {
  __m256d sums[kChains];
  for (int k = 0; k < kChains; ++k) sums[k] = _mm256_set1_pd(k);
  const __m256d factor = _mm256_set1_pd(0.999999), step = _mm256_set1_pd(1e-9);
  for (long round = 0; round < kRounds; ++round)
    for (auto& sum : sums) sum = _mm256_fmadd_pd(sum, factor, step);
  __m256d total = sums[0];
  for (int k = 1; k < kChains; ++k) total = _mm256_add_pd(total, sums[k]);
  alignas(32) double lanes[4];
  _mm256_store_pd(lanes, total);
  return lanes[0];
}
#endif

double multiplyAddPlain() {
  double sums[kChains] = {};
  for (long round = 0; round < kRounds; ++round)
    for (double& sum : sums) sum = sum * 0.999999 + 1e-9;
  double total = 0;
  for (const double sum : sums) total += sum;
  return total;
}

double operations() {
  return 2.0 * kChains * static_cast<double>(kRounds);
}

/// Runs work(thread) on some threads at once.
template <class Work>
void runOnAll(int threads, const Work& work) {
  std::vector<std::jthread> running;
  for (int t = 0; t < threads; ++t) running.emplace_back([&, t] { work(t); });
}

/// The best of some rounds.
template <class Measure>
double fastest(const Measure& measure) {
  double best = measure();
  for (int round = 0; round < 4; ++round) best = std::min(best, measure());
  return best;
}

}  // namespace

double peakFlopsPerCore(int threads) {
  std::vector<double> kept(static_cast<std::size_t>(threads));
  double (*loop)() = multiplyAddPlain;
  double lanes = 1;
#if defined(__x86_64__)
  if (bem::instructionSet() == bem::InstructionSet::kAvx512) {
    loop = multiplyAdd512;
    lanes = 8;
  } else if (bem::instructionSet() == bem::InstructionSet::kAvx2) {
    loop = multiplyAdd256;
    lanes = 4;
  }
#endif
  const double seconds = fastest([&] {
    return processorSecondsFor([&] { runOnAll(threads, [&](int t) { kept[t] = loop(); }); });
  });
  return threads * lanes * operations() / seconds;
}

double memoryBandwidth(int threads) {
  constexpr std::size_t kSize = 8'000'000;  // 64 MB each
  struct Arrays {
    std::vector<double> a, b, c;
  };
  std::vector<Arrays> arrays(static_cast<std::size_t>(threads));
  for (Arrays& each : arrays) {
    each.a.assign(kSize, 0);
    each.b.assign(kSize, 1);
    each.c.assign(kSize, 2);
  }
  const double seconds = fastest([&] {
    return secondsFor([&] {
      runOnAll(threads, [&](int t) {
        Arrays& own = arrays[t];
        for (std::size_t k = 0; k < kSize; ++k) own.a[k] = own.b[k] + 0.5 * own.c[k];
      });
    });
  });
  return 4.0 * sizeof(double) * kSize * threads / seconds;
}

}  // namespace palpa::bench
