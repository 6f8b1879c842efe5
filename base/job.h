#pragma once

#include <functional>
#include <stop_token>
#include <string_view>

namespace palpa {

/// Thrown by a long operation whose stop token was triggered; nothing of its result exists then.
/// Deliberately not a std::exception: cancelling is a result that the caller asked for, and no
/// handler of errors should swallow it.
struct Cancelled {};

/// What every long operation receives: a stop token, checked at least every 20 ms of work (CAD
/// imports say where OpenCASCADE cannot stop that fast), and a sink for progress. Both may be
/// empty.
struct Job {
  std::stop_token stop;
  /// Called with the phase ("mesh", "assemble", …) and the done fraction in [0, 1], monotone within
  /// a phase. May be called from any worker thread, one call at a time.
  std::function<void(std::string_view phase, double fraction)> progress;
  int threads = 0;  ///< worker threads for operations that use several; 0: all cores

  /// Throws Cancelled when the stop token was triggered.
  void throwIfCancelled() const {
    if (stop.stop_requested()) throw Cancelled{};
  }
  void report(std::string_view phase, double fraction) const {
    if (progress) progress(phase, fraction);
  }
};

}  // namespace palpa
