#pragma once

#include <functional>
#include <stop_token>
#include <string_view>

namespace palpa::modeling {

/// Thrown by a long operation whose stop token was triggered. Nothing of its result exists then.
struct Cancelled {};

/// What every long operation receives: a stop token, checked at least every 20 ms of work (imports
/// say where OpenCASCADE cannot stop that fast), and a sink for progress. Both may be empty.
struct Job {
  std::stop_token stop;
  /// Called with the phase ("mesh", "import", …) and the done fraction in [0, 1], monotone within a
  /// phase, from the thread that runs the operation.
  std::function<void(std::string_view phase, double fraction)> progress;

  void throwIfCancelled() const {
    if (stop.stop_requested()) throw Cancelled{};
  }
  void report(std::string_view phase, double fraction) const {
    if (progress) progress(phase, fraction);
  }
};

}  // namespace palpa::modeling
