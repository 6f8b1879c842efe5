#pragma once

#include <QTimer>
#include <chrono>
#include <vector>

namespace palpa::bench {

/// Measures how evenly the event loop of the calling thread runs: the intervals between the events
/// of a timer of one millisecond.
class Heartbeat {
 public:
  struct Gaps {
    int beats = 0;
    double largest = 0, quantile99 = 0;  ///< ms
    int above50 = 0;                     ///< gaps longer than 50 ms, which a user notices
  };

  Heartbeat();
  /// The gaps since the construction, including the present one.
  Gaps gaps() const;

 private:
  using Clock = std::chrono::steady_clock;
  QTimer timer_;
  Clock::time_point last_ = Clock::now();
  std::vector<double> gaps_;  // ms
};

}  // namespace palpa::bench
