#pragma once

#include <ostream>

#include "app/core/live/touch_snapshot.h"

namespace palpa::app {

/// The table of a replay as comma-separated values: a line of names, then a line for every contact
/// of every step, numbers with all their digits, units in the names.
class TouchTable {
 public:
  explicit TouchTable(std::ostream& out);
  /// `step`: 1 ms each, counted from the beginning of the recording.
  void add(const TouchSnapshot& snapshot, std::uint64_t step);

 private:
  std::ostream& out_;
};

/// "grab", "push", "probe", "force".
const char* nameOf(bem::ContactTool::Kind kind);
/// "waiting", "held", "open", "holding", "sticking", "slipping".
const char* nameOf(TouchSnapshot::Status status);

}  // namespace palpa::app
