#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace palpa::bench {

/// Where a program is on the PATH; empty when it is not installed.
std::string findProgram(const std::string& name);

struct ProgramRun {
  double seconds = 0;
  double peakBytes = 0;  ///< largest resident size
};
/// Runs a program in a folder and waits for it; what it prints goes to the file `log` there.
/// std::runtime_error with the end of that file when it fails.
ProgramRun runProgram(const std::vector<std::string>& command, const std::filesystem::path& folder,
                      const std::string& log);

/// An empty folder for files that programs exchange, removed in the end.
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
