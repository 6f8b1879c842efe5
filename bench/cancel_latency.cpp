#include "bench/cancel_latency.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "base/job.h"
#include "bem/base/error.h"

namespace palpa::bench {
namespace {

using Clock = std::chrono::steady_clock;

struct Phase {
  std::string name;
  Clock::time_point begin;
};

/// Seconds from the request, `after` seconds into the phase, to the end of the build; nothing when
/// the build was over before.
std::optional<double> stopOnce(const modeling::Project& project, int threads,
                               const std::string& phase, double after) {
  std::stop_source source;
  std::mutex mutex;
  std::condition_variable changed;
  bool hasBegun = false, isOver = false;
  std::optional<Clock::time_point> requested;
  std::jthread stopper([&] {
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return hasBegun || isOver; });
    if (changed.wait_for(lock, std::chrono::duration<double>(after), [&] { return isOver; }))
      return;
    requested = Clock::now();
    source.request_stop();
  });
  Job job;
  job.threads = threads;
  job.stop = source.get_token();
  job.progress = [&](std::string_view now, double) {
    if (now != phase) return;
    const std::lock_guard lock(mutex);
    hasBegun = true;
    changed.notify_one();
  };
  bool isStopped = false;
  try {
    app::buildTouchModel(project, {}, job);
  } catch (const Cancelled&) {
    isStopped = true;
  }
  const auto end = Clock::now();
  const std::lock_guard lock(mutex);
  isOver = true;
  changed.notify_one();
  if (!isStopped || !requested) return std::nullopt;
  return std::chrono::duration<double>(end - *requested).count();
}

}  // namespace

std::vector<CancelLatency> measureCancel(const modeling::Project& project, int threads,
                                         int stopsPerPhase) {
  std::vector<Phase> phases;
  Job job;
  job.threads = threads;
  std::mutex mutex;
  job.progress = [&](std::string_view phase, double) {
    const std::lock_guard lock(mutex);
    if (phases.empty() || phases.back().name != phase)
      phases.push_back({std::string(phase), Clock::now()});
  };
  app::buildTouchModel(project, {}, job);
  phases.push_back({"", Clock::now()});
  std::vector<CancelLatency> result;
  for (std::size_t p = 0; p + 1 < phases.size(); ++p) {
    const double length =
        std::chrono::duration<double>(phases[p + 1].begin - phases[p].begin).count();
    CancelLatency latency{phases[p].name, 0};
    for (int k = 0; k < stopsPerPhase; ++k)
      if (const auto seconds =
              stopOnce(project, threads, latency.phase, length * (k + 0.5) / stopsPerPhase))
        latency.seconds = std::max(latency.seconds, *seconds);
    result.push_back(latency);
  }
  return result;
}

}  // namespace palpa::bench
