#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "bem/contact/contact_simulation.h"

namespace palpa::app {

/// Names one contact of a touch loop; never used again for another. 0: none.
using TouchId = std::uint32_t;

/// What mouse, script and device alike say to the body.
struct TouchCommand {
  enum class Kind : unsigned char { kBegin, kSet, kEnd };
  Kind kind = Kind::kBegin;
  TouchId id = 0;
  bem::ContactTool tool{};                          ///< of kBegin
  Eigen::Vector3d at = Eigen::Vector3d::Zero();     ///< of kBegin: mm, on the unloaded shape
  Eigen::Vector3d value = Eigen::Vector3d::Zero();  ///< of kBegin and kSet, see ContactSimulation
};

/// Everything that was said to a loop, in its order: enough to do it again.
struct TouchRecording {
  struct Entry {
    std::uint64_t step = 0;  ///< before which step, counted from the beginning of the recording
    TouchCommand command;
  };
  std::vector<Entry> entries;
  std::uint64_t steps = 0;  ///< that were made, 1 ms each
  /// How often the model was replaced meanwhile. Replayed on one model the forces are then others.
  int modelChanges = 0;
  /// Entries were lost because there were more than the recording had room for.
  bool isFull = false;
};

}  // namespace palpa::app
