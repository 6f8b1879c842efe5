#pragma once

#include <chrono>
#include <memory>
#include <vector>

#include "app/core/live/touch_loop.h"
#include "bench/timing.h"

namespace palpa::bench {

struct LatencyReport {
  /// As measured by the loop: from set() to the published force, and its parts.
  app::TouchLoop::Latencies inside;
  /// s, from set() until another thread, which checks every 50 µs, has the force
  Quantiles latency;
  double rate = 0;          ///< steps per second, over the whole run
  double firstForce = 0;    ///< s, from a touch on a body without columns to its first force
  double columnsReady = 0;  ///< at the end
  int displayed = 0;        ///< fields evaluated by another thread at 60 per second
};

/// Moves one of `contacts` grabs on the sphere for some time, not synchronised with the loop, and
/// measures the latency of forces; another thread evaluates the whole field 60 times a second.
/// `computesAll`: all columns are computed in the background meanwhile; otherwise only the touched
/// ones, beforehand.
LatencyReport measureLatency(const std::shared_ptr<const app::TouchModel>& model, int contacts,
                             std::chrono::duration<double> duration, bool computesAll);

/// Times of touches of new places, one after another, while columns are computed in the background.
struct NewPlaces {
  std::vector<double> first;    ///< s until there is a force
  std::vector<double> settled;  ///< s until it is within 1 % of its value 10 s later
};
/// A tool that grabs or presses some places on the sphere. `answersPlacesFrom`: see
/// TouchWorker::Options.
NewPlaces touchNewPlaces(const std::shared_ptr<const app::TouchModel>& model,
                         const bem::ContactTool& tool, int places, Eigen::Index answersPlacesFrom);

}  // namespace palpa::bench
