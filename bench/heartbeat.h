#pragma once

#include <QTimer>
#include <chrono>
#include <vector>

namespace palpa::bench {

/// How evenly the event loop of the calling thread runs: a timer that fires every millisecond, and
/// how long it really took from one time to the next.
class Heartbeat {
 public:
  struct Gaps {
    int beats = 0;
    double largest = 0, quantile99 = 0;  ///< ms
    int above50 = 0;                     ///< that a person would feel: longer than 50 ms
  };

  Heartbeat();
  /// The gaps since the construction; the one that lasts now counts.
  Gaps gaps() const;

 private:
  using Clock = std::chrono::steady_clock;
  QTimer timer_;
  Clock::time_point last_ = Clock::now();
  std::vector<double> gaps_;  // ms
};

}  // namespace palpa::bench
