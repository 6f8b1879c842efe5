#include "modeling/exchange/rehearsal.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>

#include "modeling/error.h"
#include "modeling/text.h"

namespace palpa::modeling {
namespace {

constexpr rlim_t kMemory = rlim_t{8} << 30;  // bytes the child may use beyond what is used now
constexpr double kPatience = 20.0;           // waiting for the child, in its own seconds
constexpr int kFailed = 100;                 // exit code for a ModelingError, plus its kind

void setLimits(double seconds) {
  long pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t bytes = static_cast<rlim_t>(pages) * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
  rlimit limit{};
  ::getrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = std::min(limit.rlim_max, bytes + kMemory);
  ::setrlimit(RLIMIT_AS, &limit);
  const auto whole = static_cast<rlim_t>(std::ceil(seconds));
  const rlimit time{whole, whole + 1};
  ::setrlimit(RLIMIT_CPU, &time);
  const rlimit noCore{0, 0};
  ::setrlimit(RLIMIT_CORE, &noCore);
}

[[noreturn]] void runChild(const std::function<void()>& work, double seconds, int pipe) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL}) std::signal(signal, SIG_DFL);
  const int nothing = ::open("/dev/null", O_WRONLY);
  ::dup2(nothing, STDOUT_FILENO);
  ::dup2(nothing, STDERR_FILENO);
  setLimits(seconds);
  try {
    work();
  } catch (const ModelingError& error) {
    const std::string message = error.what();
    const ssize_t written = ::write(pipe, message.data(), message.size());
    ::_exit(written < 0 ? 1 : kFailed + static_cast<int>(error.kind()));
  } catch (...) {
    ::_exit(1);
  }
  ::_exit(0);
}

/// Collects the child's message until it ends; kills it when time is up or the job is stopped.
class Child {
 public:
  Child(pid_t process, int pipe) : process_(process), pipe_(pipe) {}
  ~Child() {
    if (process_ > 0) {
      ::kill(process_, SIGKILL);
      waitForEnd();
    }
    ::close(pipe_);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// False when the time is up.
  bool listen(double seconds, const Job& job) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    std::array<char, 4096> buffer;
    while (std::chrono::steady_clock::now() < end) {
      job.throwIfCancelled();
      pollfd waiting{pipe_, POLLIN, 0};
      constexpr int kMilliseconds = 10;
      if (::poll(&waiting, 1, kMilliseconds) <= 0) continue;
      const ssize_t count = ::read(pipe_, buffer.data(), buffer.size());
      if (count == 0) return true;
      if (count > 0) message_.append(buffer.data(), static_cast<std::size_t>(count));
    }
    return false;
  }

  int waitForEnd() {
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    return status;
  }

  const std::string& message() const { return message_; }

 private:
  pid_t process_;
  int pipe_;
  std::string message_;
};

}  // namespace

void rehearse(const std::function<void()>& work, const std::string& source, double seconds,
              const Job& job) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw ModelingError(source + ": no pipe could be opened", ModelingError::Kind::io);
  const pid_t process = ::fork();
  if (process == 0) runChild(work, seconds, ends[1]);
  ::close(ends[1]);
  if (process < 0) {
    ::close(ends[0]);
    throw ModelingError(source + ": no process could be started", ModelingError::Kind::io);
  }
  Child child(process, ends[0]);
  const bool ended = child.listen(kPatience * seconds, job);
  const int status = ended ? child.waitForEnd() : 0;
  if (!ended || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU))
    throw ModelingError(source + ": OpenCASCADE works on it for longer than " +
                            shortNumberText(seconds) + " s; the file is damaged or too complicated",
                        ModelingError::Kind::tooLarge);
  if (!WIFEXITED(status) || (WEXITSTATUS(status) != 0 && WEXITSTATUS(status) < kFailed))
    throw ModelingError(source + ": OpenCASCADE fails on it; the file is damaged");
  if (WEXITSTATUS(status) >= kFailed)
    throw ModelingError(child.message(),
                        static_cast<ModelingError::Kind>(WEXITSTATUS(status) - kFailed));
}

}  // namespace palpa::modeling
