#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

namespace palpa::cli {

/// Progress of long work as one line on standard error, rewritten in place: "assemble  45 %".
/// Silent unless standard error is a terminal. Thread-safe.
class ProgressLine {
 public:
  explicit ProgressLine(bool wanted);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(std::string_view phase, double fraction);

  /// Removes the line, so that other output can follow.
  void clear();

 private:
  bool enabled_;
  std::mutex mutex_;
  std::string shown_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace palpa::cli
