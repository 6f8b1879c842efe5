#pragma once

#include <ostream>

#include "app/core/live/touch_snapshot.h"

namespace palpa::app {

/// Writes a replay as comma-separated values: a line of names with units, then a line for every
/// contact of every step, numbers with all their digits.
class TouchTable {
 public:
  explicit TouchTable(std::ostream& out);
  /// `step`: 1 ms each, counted from the beginning of the recording.
  void add(const TouchSnapshot& snapshot, std::uint64_t step);

 private:
  std::ostream& out_;
};

/// Name in tables and reports: "waiting", "held" (on a support), "open", "holding" (grabbed),
/// "sticking", "slipping".
const char* nameOf(TouchSnapshot::Status status);

}  // namespace palpa::app
