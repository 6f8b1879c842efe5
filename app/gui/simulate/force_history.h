#pragma once

#include <deque>
#include <vector>

#include "app/core/live/touch_snapshot.h"

namespace palpa::gui {

/// Forces of the last seconds, one sample per drawn frame.
class ForceHistory {
 public:
  static constexpr double kSeconds = 15;

  struct Sample {
    double time;                                          ///< since the first sample, s
    std::vector<std::pair<app::TouchId, double>> forces;  ///< of each contact, N
  };

  void add(const app::TouchSnapshot& snapshot) {
    if (samples_.empty()) begin_ = snapshot.time;
    const double time = std::chrono::duration<double>(snapshot.time - begin_).count();
    if (!samples_.empty() && time <= samples_.back().time) return;
    Sample sample{time, {}};
    for (const auto& contact : snapshot.touched())
      sample.forces.emplace_back(contact.id, contact.force.norm());
    samples_.push_back(std::move(sample));
    while (samples_.front().time < time - kSeconds) samples_.pop_front();
  }
  void clear() { samples_.clear(); }
  const std::deque<Sample>& samples() const { return samples_; }

 private:
  std::chrono::steady_clock::time_point begin_;
  std::deque<Sample> samples_;
};

}  // namespace palpa::gui
