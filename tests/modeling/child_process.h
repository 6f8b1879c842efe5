#pragma once

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

// Child processes for tests of crashes, and folders for their files.
namespace palpa::testing_support {

/// Runs `work` in a child process, which ends when it returns, with 0.
template <class Work>
pid_t startChild(Work work) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  try {
    work();
  } catch (...) {
    ::_exit(1);
  }
  ::_exit(0);
}

/// Kills the child the hard way and waits for its end.
inline void killChild(pid_t child) {
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
}

/// Waits for the child's own end: its exit code, or -1 when it was killed.
inline int resultOf(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Numbers that a child process reports to its parent. Made before the child is started.
class Reports {
 public:
  Reports() {
    if (::pipe(ends_) != 0) throw std::runtime_error("no pipe");
  }
  Reports(const Reports&) = delete;
  Reports& operator=(const Reports&) = delete;
  ~Reports() {
    stopWriting();
    ::close(ends_[0]);
  }

  void report(std::uint64_t number) {
    if (::write(ends_[1], &number, sizeof number) != sizeof number) ::_exit(1);
  }

  /// Waits for the next number; nothing once all writers have ended or stopped.
  std::optional<std::uint64_t> next() {
    std::uint64_t number = 0;
    if (::read(ends_[0], &number, sizeof number) != sizeof number) return std::nullopt;
    return number;
  }

  void stopWriting() {
    if (ends_[1] >= 0) ::close(ends_[1]);
    ends_[1] = -1;
  }

 private:
  int ends_[2];
};

/// Runs `work(reports)` in a child, lets it report `count` numbers and a little longer, kills it
/// and gives the last number it reported.
template <class Work>
std::uint64_t killAmongReports(int count, int microseconds, Work work) {
  Reports reports;
  const pid_t child = startChild([&] { work(reports); });
  reports.stopWriting();  // the child has its own end
  std::uint64_t last = 0;
  for (int i = 0; i < count; ++i) last = reports.next().value_or(last);
  ::usleep(static_cast<useconds_t>(microseconds));
  killChild(child);
  while (const auto number = reports.next()) last = *number;
  return last;
}

/// An empty folder that goes with its object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "palpa_test_XXXXXX").string();
    path_ = ::mkdtemp(name.data()) ? name : throw std::runtime_error("no temporary folder");
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code code;
    std::filesystem::remove_all(path_, code);
  }

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  /// Number of files and folders in it, hidden ones included.
  long size() const { return std::distance(std::filesystem::directory_iterator(path_), {}); }

 private:
  std::filesystem::path path_;
};

}  // namespace palpa::testing_support
