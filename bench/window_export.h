#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/window_driver.h"

namespace palpa::bench {

/// Time to export the forces of a recorded touch (Simulate > Export forces).
struct ExportRow {
  std::string project, tool;
  double recordedSeconds = 0;
  double wallSeconds = 0, processorSeconds = 0;  ///< of a replay without any columns, as after
                                                 ///< opening the recording
  double columnsThereSeconds = 0;  ///< processor time with the columns of the touch itself
};

/// Opens a project, records a touch of `seconds` with the tools Grab and Ball, and exports the
/// forces of each. Throws std::runtime_error if the body cannot be touched.
std::vector<ExportRow> measureExports(WindowDriver& driver, const std::filesystem::path& project,
                                      double seconds);

/// Prints a line for each row.
void printExports(const std::vector<ExportRow>& rows);

}  // namespace palpa::bench
