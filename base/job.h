#pragma once

#include <functional>
#include <stop_token>

#include "base/phase.h"

namespace palpa {

/// Thrown by a long operation whose stop token was triggered; there is no partial result. Not a
/// std::exception, so that no handler of errors swallows it: the caller asked for the cancellation.
struct Cancelled {};

/// Parameter of every long operation: a stop token, checked at least every 20 ms of work (the
/// documentation of CAD imports names the exceptions), and a callback for progress. Both may be
/// empty.
struct Job {
  std::stop_token stop;
  /// Called with the phase and its done fraction in [0, 1], which never falls within a phase. May
  /// be called from any worker thread, one call at a time.
  std::function<void(Phase phase, double fraction)> progress;
  int threads = 0;  ///< worker threads for operations that use several; 0: all cores

  /// Throws Cancelled if the stop token was triggered.
  void throwIfCancelled() const {
    if (stop.stop_requested()) throw Cancelled{};
  }
  void report(Phase phase, double fraction) const {
    if (progress) progress(phase, fraction);
  }
};

}  // namespace palpa
