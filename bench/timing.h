#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <utility>
#include <vector>

namespace palpa::bench {

/// Quantiles of durations, s.
struct Quantiles {
  double p50 = 0, p99 = 0, largest = 0;
  int count = 0;
};

inline Quantiles quantilesOf(std::vector<double> times) {
  if (times.empty()) return {};
  std::sort(times.begin(), times.end());
  const std::size_t last = times.size() - 1;
  return {times[last / 2], times[last * 99 / 100], times[last], static_cast<int>(times.size())};
}

template <class Work>
double secondsFor(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Processor time of all threads of this program, s; other programs do not count.
template <class Work>
double processorSecondsFor(const Work& work) {
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  const double start = now();
  work();
  return now() - start;
}

/// Median over the repetitions of half a second (3 to 5,000).
template <class Work>
double medianSecondsFor(const Work& work) {
  std::vector<double> times;
  for (double total = 0; times.size() < 3 || (total < 0.5 && times.size() < 5000);) {
    times.push_back(secondsFor(work));
    total += times.back();
  }
  return quantilesOf(std::move(times)).p50;
}

}  // namespace palpa::bench
