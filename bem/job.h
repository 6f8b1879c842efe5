#pragma once
#include <functional>
#include <stop_token>
#include <string_view>

#include "bem/error.h"

namespace palpa::bem {

/// What every long operation receives: a stop token, checked at least every 20 ms of work, and a
/// sink for progress. Both may be empty. `threads` = 0 means all cores.
struct Job {
  std::stop_token stop;
  /// Called with the phase ("assemble", "factorise", …) and the done fraction in [0, 1], monotone
  /// within a phase. May be called from any worker thread, one call at a time.
  std::function<void(std::string_view phase, double fraction)> progress;
  int threads = 0;

  void throwIfCancelled() const {
    if (stop.stop_requested()) throw Cancelled{};
  }
  void report(std::string_view phase, double fraction) const {
    if (progress) progress(phase, fraction);
  }
};

}  // namespace palpa::bem
