#include "modeling/exchange/sandboxed_read.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <vector>

#include "base/text.h"
#include "modeling/error.h"

namespace palpa::modeling {
namespace {

constexpr double kPatience = 20.0;  // largest elapsed time, of the allowed processor time
constexpr const char* kProgram = "palpa-read-cad";

/// Folder of the file that contains this code: the Python module, or a program.
std::filesystem::path folderOfThisCode() {
  Dl_info info{};
  if (::dladdr(reinterpret_cast<const void*>(&folderOfThisCode), &info) == 0) return {};
  return std::filesystem::path(info.dli_fname).parent_path();
}

std::filesystem::path findProgram(const std::string& source) {
  const std::filesystem::path here = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  for (const auto& folder : {here, here.parent_path() / "libexec" / "palpa", folderOfThisCode()})
    if (::access((folder / kProgram).c_str(), X_OK) == 0) return folder / kProgram;
  throw ModelingError(source + ": the program " + kProgram + " is missing in " + here.string() +
                          "; install Palpa again",
                      ModelingError::Kind::kNotFound);
}

/// File descriptor that is closed in the destructor.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

/// An unnamed file with the content `text`, positioned at its beginning.
int fileInMemory(const std::string& text) {
  const int file = ::memfd_create("cad", MFD_CLOEXEC);
  std::size_t done = 0;
  while (file >= 0 && done < text.size()) {
    const ssize_t count = ::write(file, text.data() + done, text.size() - done);
    if (count < 0 && errno != EINTR) break;
    done += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
  }
  if (file >= 0 && (done < text.size() || ::lseek(file, 0, SEEK_SET) != 0)) {
    ::close(file);
    return -1;
  }
  return file;
}

/// Starts a program by posix_spawn: after fork() in a program with threads, the child may inherit a
/// lock that no thread releases.
pid_t start(std::vector<std::string> words, int input, int output) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  // Default signals: otherwise the child inherits the ignored and blocked signals of the parent.
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  sigset_t all, none;
  ::sigfillset(&all);
  ::sigemptyset(&none);
  ::posix_spawnattr_setsigdefault(&attributes, &all);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  pid_t process = -1;
  const int error =
      ::posix_spawn(&process, arguments[0], &actions, &attributes, arguments.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
  return error == 0 ? process : -1;
}

/// Child process: its message is collected until it ends; it is killed after the time limit or when
/// the job is stopped.
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

  /// Returns false if the child is silent for `seconds`.
  bool listen(double seconds, const Job& job) {
    const auto now = [] { return std::chrono::steady_clock::now(); };
    const std::chrono::duration<double> allowed(seconds);
    auto end = now() + allowed;
    std::array<char, 4096> buffer;
    while (now() < end) {
      job.throwIfCancelled();
      pollfd waiting{pipe_, POLLIN, 0};
      constexpr int kMilliseconds = 10;
      if (::poll(&waiting, 1, kMilliseconds) <= 0) continue;
      const ssize_t count = ::read(pipe_, buffer.data(), buffer.size());
      if (count == 0) return true;
      if (count < 0) continue;
      message_.append(buffer.data(), static_cast<std::size_t>(count));
      end = now() + allowed;
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

/// How a run of the program ended.
struct Ended {
  bool inTime = true;
  int status = 0;  // exit status; EXIT_FAILURE after a crash
  std::string message;
};

Ended runProgram(const std::string& source, const std::string& text, const CadRequest& request,
                 double seconds, const Job& job) {
  const std::filesystem::path program = findProgram(source);
  std::array<int, 2> ends{-1, -1};
  const Descriptor input(fileInMemory(text));
  if (input.number() < 0 || ::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw ModelingError(
        source + ": not enough memory or pipes for " + kProgram + "; close other programs",
        ModelingError::Kind::kIo);
  Descriptor output(ends[1]);
  const pid_t process = start(
      {program.string(), std::to_string(::getpid()), numberText(seconds), source, toText(request)},
      input.number(), output.number());
  output.close();
  Child child(process, ends[0]);
  if (process < 0)
    throw ModelingError(source + ": " + program.string() +
                            " could not be started; close other programs, or install Palpa again",
                        ModelingError::Kind::kIo);
  Ended ended;
  ended.inTime = child.listen(kPatience * seconds, job);
  const int status = ended.inTime ? child.waitForEnd() : 0;
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) ended.inTime = false;
  ended.status = WIFEXITED(status) ? WEXITSTATUS(status) : EXIT_FAILURE;
  ended.message = child.message();
  return ended;
}

/// The error of a run without an answer: it took too long, or it crashed.
ModelingError failureOf(const std::string& source, const Ended& ended, double seconds) {
  if (!ended.inTime)
    return ModelingError(source + ": OpenCASCADE needs longer than " + shortNumberText(seconds) +
                             " s for the file; it is damaged or too complicated: simplify the "
                             "part, or export it in another format",
                         ModelingError::Kind::kTooLarge);
  return ModelingError(source +
                       ": OpenCASCADE crashes on the file; it is damaged: export it again, or in "
                       "another format");
}

}  // namespace

std::string readInSandbox(const std::filesystem::path& path, const std::string& text,
                          const CadRequest& request, double seconds, const Job& job) {
  const std::string source = path.string();
  const Ended ended = runProgram(source, text, request, seconds, job);
  if (ended.inTime && ended.status == kSandboxSeveral)
    throw SeveralBodies(source + ": ", fileBodiesFrom(ended.message));
  if (ended.inTime && ended.status >= kSandboxFailed)
    throw ModelingError(ended.message,
                        static_cast<ModelingError::Kind>(ended.status - kSandboxFailed));
  if (!ended.inTime || ended.status != 0) throw failureOf(source, ended, seconds);
  return ended.message;
}

std::vector<std::string> readAllInSandbox(const std::filesystem::path& path,
                                          const std::string& text, std::size_t count,
                                          const ImportOptions& options, double seconds,
                                          const Job& job) {
  const std::string source = path.string();
  std::vector<std::string> problems(count);
  for (std::size_t first = 0; first < count;) {
    const Ended ended =
        runProgram(source, text, {.allFrom = first, .options = options}, seconds, job);
    const SolidsRead read = solidsReadFrom(ended.message);
    for (const auto& [index, problem] : read.ended)
      if (index < count) problems[index] = problem;
    if (ended.inTime && ended.status == 0) break;
    if (ended.inTime && ended.status >= kSandboxFailed)
      throw ModelingError(ended.message,
                          static_cast<ModelingError::Kind>(ended.status - kSandboxFailed));
    const ModelingError failure = failureOf(source, ended, seconds);
    if (!read.unfinished || *read.unfinished >= count) throw failure;
    problems[*read.unfinished] = failure.what();
    first = *read.unfinished + 1;
  }
  return problems;
}

}  // namespace palpa::modeling
