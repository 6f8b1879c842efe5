#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>

namespace palpa::app {

/// Statistics of durations, s.
struct Latency {
  std::uint64_t count = 0;
  double p50 = 0, p99 = 0, p999 = 0, largest = 0;  ///< quantiles to 20 µs, up to 40 ms
  /// Ends of the classes, s; the last class has none.
  static constexpr std::array kEnds{0.1e-3, 0.2e-3, 0.3e-3, 0.5e-3, 0.7e-3, 1e-3,
                                    1.5e-3, 2e-3,   3e-3,   5e-3,   10e-3};
  std::array<std::uint64_t, kEnds.size() + 1> classes{};  ///< counts
};

/// Histogram of durations without locks: one thread adds, others read.
class LatencyHistogram {
 public:
  void add(std::chrono::nanoseconds time) {
    const auto bin = std::clamp<std::int64_t>(time / kBin, 0, kBins - 1);
    counts_[bin].fetch_add(1, std::memory_order_relaxed);
    if (time.count() > largest_.load(std::memory_order_relaxed))
      largest_.store(time.count(), std::memory_order_relaxed);
  }
  /// Durations that are added meanwhile may be lost.
  void clear() {
    for (auto& count : counts_) count.store(0, std::memory_order_relaxed);
    largest_.store(0, std::memory_order_relaxed);
  }
  Latency read() const {
    std::array<std::uint64_t, kBins> counts{};
    Latency latency;
    for (int k = 0; k < kBins; ++k)
      latency.count += counts[k] = counts_[k].load(std::memory_order_relaxed);
    latency.largest = 1e-9 * static_cast<double>(largest_.load(std::memory_order_relaxed));
    const auto quantile = [&](double part) {
      std::uint64_t below = 0;
      for (int k = 0; k < kBins; ++k)
        if ((below += counts[k]) > 0 &&
            static_cast<double>(below) >= part * static_cast<double>(latency.count))
          return std::min(1e-9 * static_cast<double>((k + 1) * kBin.count()), latency.largest);
      return latency.largest;
    };
    latency.p50 = quantile(0.5);
    latency.p99 = quantile(0.99);
    latency.p999 = quantile(0.999);
    std::size_t k = 0;
    for (int bin = 0; bin < kBins; ++bin) {
      while (k < Latency::kEnds.size() &&
             (bin + 0.5) * static_cast<double>(kBin.count()) > 1e9 * Latency::kEnds[k])
        ++k;
      latency.classes[k] += counts[bin];
    }
    return latency;
  }

 private:
  static constexpr int kBins = 2000;
  static constexpr std::chrono::nanoseconds kBin{20'000};
  std::array<std::atomic<std::uint32_t>, kBins> counts_{};
  std::atomic<std::int64_t> largest_{0};  // ns
};

}  // namespace palpa::app
