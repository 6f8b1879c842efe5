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

// Child processes for tests of crashes, and temporary folders.
namespace palpa::testing_support {

/// Runs `work` in a child process, which exits with 0 when `work` returns.
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

/// Kills the child by SIGKILL and waits for its end.
inline void killChild(pid_t child) {
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
}

/// Waits for the end of the child: its exit code, or -1 if it was killed.
inline int resultOf(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Channel of numbers from a child process to its parent. Construct it before starting the child.
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

  /// Waits for the next number; none if all writers have ended or stopped.
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

/// Runs `work(reports)` in a child, waits for `count` reported numbers and a short additional time,
/// kills the child and returns the last number it reported.
template <class Work>
std::uint64_t killAmongReports(int count, int microseconds, Work work) {
  Reports reports;
  const pid_t child = startChild([&] { work(reports); });
  reports.stopWriting();  // the child has its own copy of the end
  std::uint64_t last = 0;
  for (int i = 0; i < count; ++i) last = reports.next().value_or(last);
  ::usleep(static_cast<useconds_t>(microseconds));
  killChild(child);
  while (const auto number = reports.next()) last = *number;
  return last;
}

/// Empty folder, removed by the destructor.
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

  /// Number of files and folders in it, including hidden ones.
  long size() const { return std::distance(std::filesystem::directory_iterator(path_), {}); }

 private:
  std::filesystem::path path_;
};

}  // namespace palpa::testing_support
