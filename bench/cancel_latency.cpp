#include "bench/cancel_latency.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "app/core/model/build_touch_model.h"
#include "base/job.h"
#include "bem/base/error.h"

namespace palpa::bench {
namespace {

using Clock = std::chrono::steady_clock;

struct PhaseBegin {
  Phase phase;
  Clock::time_point begin;
};

/// Seconds from the request, `after` seconds into the phase, to the end of the build; none if the
/// build had ended before.
std::optional<double> stopOnce(const modeling::Project& project, int threads, Phase phase,
                               double after) {
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
  job.progress = [&](Phase now, double) {
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
  std::vector<PhaseBegin> phases;
  Job job;
  job.threads = threads;
  std::mutex mutex;
  job.progress = [&](Phase phase, double) {
    const std::lock_guard lock(mutex);
    if (phases.empty() || phases.back().phase != phase) phases.push_back({phase, Clock::now()});
  };
  app::buildTouchModel(project, {}, job);
  const auto end = Clock::now();
  std::vector<CancelLatency> result;
  for (std::size_t p = 0; p < phases.size(); ++p) {
    const auto next = p + 1 < phases.size() ? phases[p + 1].begin : end;
    const double length = std::chrono::duration<double>(next - phases[p].begin).count();
    CancelLatency latency{phases[p].phase, 0};
    for (int k = 0; k < stopsPerPhase; ++k)
      if (const auto seconds =
              stopOnce(project, threads, latency.phase, length * (k + 0.5) / stopsPerPhase))
        latency.seconds = std::max(latency.seconds, *seconds);
    result.push_back(latency);
  }
  return result;
}

}  // namespace palpa::bench
