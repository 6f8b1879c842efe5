#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace palpa::reliability {

/// Faults of the files of a folder and its folder "written" that are newer than `since`: hidden
/// files of interrupted exports, and files that cannot be read again as a whole, by the format of
/// their ending.
std::vector<std::string> faultsOf(const std::filesystem::path& folder,
                                  std::filesystem::file_time_type since);

}  // namespace palpa::reliability
