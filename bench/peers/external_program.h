#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace palpa::bench {

/// Path of a program on the PATH; empty if it is not installed.
std::string findProgram(const std::string& name);

struct ProgramRun {
  double seconds = 0;
  double peakBytes = 0;  ///< largest resident size
};
/// Runs a program in a folder and waits for it; its output goes to the file `log` in the folder.
/// Throws std::runtime_error with the end of this file if it fails.
ProgramRun runProgram(const std::vector<std::string>& command, const std::filesystem::path& folder,
                      const std::string& log);

/// Temporary folder for files that programs exchange; the destructor removes it.
class ExchangeFolder {
 public:
  ExchangeFolder();
  ~ExchangeFolder();
  ExchangeFolder(const ExchangeFolder&) = delete;
  ExchangeFolder& operator=(const ExchangeFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace palpa::bench
