#include "bench/heartbeat.h"

#include <algorithm>

namespace palpa::bench {

Heartbeat::Heartbeat() {
  timer_.setTimerType(Qt::PreciseTimer);
  QObject::connect(&timer_, &QTimer::timeout, [this] {
    const auto now = Clock::now();
    gaps_.push_back(std::chrono::duration<double, std::milli>(now - last_).count());
    last_ = now;
  });
  timer_.start(1);
}

Heartbeat::Gaps Heartbeat::gaps() const {
  std::vector<double> sorted = gaps_;
  sorted.push_back(std::chrono::duration<double, std::milli>(Clock::now() - last_).count());
  std::sort(sorted.begin(), sorted.end());
  Gaps gaps;
  gaps.beats = static_cast<int>(sorted.size());
  gaps.largest = sorted.back();
  gaps.quantile99 = sorted[(sorted.size() - 1) * 99 / 100];
  gaps.above50 = static_cast<int>(
      std::count_if(sorted.begin(), sorted.end(), [](double gap) { return gap > 50; }));
  return gaps;
}

}  // namespace palpa::bench
