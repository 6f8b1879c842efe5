#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/window_driver.h"

namespace palpa::bench {

/// Frames of one phase, in which the user works for some seconds with a project in a window.
struct FrameRow {
  std::string project, size, phase;
  double perSecond = 0;
  double viewMilliseconds = 0;       ///< to draw a frame in the view
  double processorMilliseconds = 0;  ///< of all threads of the process, per frame
};

/// Frames per second with a project file in windows of each size: while the view orbits,
/// a control point is dragged, the surface is pulled in Simulate mode, and the view orbits there.
std::vector<FrameRow> measureFrames(WindowDriver& driver, const std::filesystem::path& project,
                                    double seconds, const std::vector<QSize>& sizes);

/// Measures in alternation, `rounds` times, with this program and with another version of it, and
/// prints medians of both with the load of the machine; without `other` only of this one. Each
/// round is a separate process. Returns the number of phases below their goal.
int compareFrames(const std::vector<std::filesystem::path>& projects, double seconds, int rounds,
                  const std::string& other);

/// Prints rows as text that compareFrames() reads.
void printFrames(const std::vector<FrameRow>& rows);

}  // namespace palpa::bench
