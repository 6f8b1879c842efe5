// Ctrl-C stops the work in an orderly way, within a moment.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>

#include "tests/app/cli_runner.h"

namespace palpa::cli_tests {
namespace {

using Clock = std::chrono::steady_clock;

TEST(CliCancel, AnInterruptEndsWithItsOwnExitCode) {
  const Runner cli;
  // About 4,000 nodes: several seconds of assembly and factorisation, in 3 GiB.
  cli.run("new sphere --radius 25 -o p.json");
  const std::string file = cli.path("p.json").string();
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    execl(PALPA_CLI, "palpa-cli", "solve", file.c_str(), "--edge-length", "1.4", "--quiet",
          static_cast<char*>(nullptr));
    _exit(127);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(1000));
  const auto start = Clock::now();
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  const std::chrono::duration<double> waited = Clock::now() - start;
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 5);
  // Usually a tenth of a second; a virtual machine may need seconds to provide memory.
  EXPECT_LT(waited.count(), 6.0);
}

/// Whether a process has a child process. A process that has ended has none.
bool hasChild(pid_t process) {
  std::error_code none;
  const std::filesystem::path tasks = "/proc/" + std::to_string(process) + "/task";
  for (const auto& task : std::filesystem::directory_iterator(tasks, none)) {
    std::ifstream children(task.path() / "children");
    pid_t child = 0;
    if (children >> child) return true;
  }
  return false;
}

// Ctrl-C in a terminal also reaches the program that reads CAD files, from its first instruction
// on.
TEST(CliCancel, AnInterruptOfAnImportIsNoDamagedFile) {
  const Runner cli;
  cli.run("new sphere --radius 25 -o p.json");
  cli.run("export p.json -o p.step");
  const std::string file = cli.path("p.step").string();
  const std::string target = cli.path("imported.json").string();
  const std::string messages = cli.path("messages.txt").string();
  int cancelled = 0;
  for (int wait = 0; wait <= 20; ++wait) {
    const pid_t process = fork();
    ASSERT_GE(process, 0);
    if (process == 0) {
      setpgid(0, 0);
      if (!freopen(messages.c_str(), "w", stderr)) _exit(126);
      execl(PALPA_CLI, "palpa-cli", "import", file.c_str(), "-o", target.c_str(),
            static_cast<char*>(nullptr));
      _exit(127);
    }
    int status = 0;
    pid_t ended = 0;
    while (ended == 0 && !hasChild(process)) ended = waitpid(process, &status, WNOHANG);
    if (ended != 0) {
      // On a busy machine the program may do all of its work while this loop waits for a processor.
      EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << cli.read("messages.txt");
      continue;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(wait * wait));
    kill(-process, SIGINT);
    waitpid(process, &status, 0);
    // A late signal finds the work done, or ends the program after its work.
    if (WIFSIGNALED(status)) {
      EXPECT_EQ(WTERMSIG(status), SIGINT);
      continue;
    }
    EXPECT_TRUE(WEXITSTATUS(status) == 5 || WEXITSTATUS(status) == 0)
        << wait << ": " << cli.read("messages.txt");
    if (WEXITSTATUS(status) == 5) ++cancelled;
  }
  EXPECT_GT(cancelled, 0);
}

}  // namespace
}  // namespace palpa::cli_tests
