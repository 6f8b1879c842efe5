#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "bem/contact/contact_simulation.h"

namespace palpa::app {

/// Number of a contact of a touch loop; never reused. 0: none.
using TouchId = std::uint32_t;

/// Command of a mouse, script or device to a touch loop.
struct TouchCommand {
  enum class Kind : unsigned char { kBegin, kSet, kEnd };
  Kind kind = Kind::kBegin;
  TouchId id = 0;
  bem::ContactTool tool{};                          ///< of kBegin
  Eigen::Vector3d at = Eigen::Vector3d::Zero();     ///< of kBegin: mm, on the unloaded shape
  Eigen::Vector3d value = Eigen::Vector3d::Zero();  ///< of kBegin and kSet, see ContactSimulation
};

/// All commands to a loop in their order, sufficient for a replay.
struct TouchRecording {
  struct Entry {
    std::uint64_t step =
        0;  ///< that follows the command, counted from the beginning of the recording
    TouchCommand command;
  };
  std::vector<Entry> entries;
  std::uint64_t steps = 0;  ///< number of steps, 1 ms each
  /// Number of model changes during the recording. If it is not 0, a replay on one model gives
  /// other forces.
  int modelChanges = 0;
  /// True if entries were lost because the recording was full.
  bool isFull = false;
};

}  // namespace palpa::app
