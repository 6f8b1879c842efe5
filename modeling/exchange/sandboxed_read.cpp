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
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/exchange/cad_request.h"

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
  // Ctrl+C in a terminal reaches both programs, and the parent has to answer it: a child that ends
  // by it looks like a crash. The block holds from the child's first instruction on.
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  sigset_t all, blocked;
  ::sigfillset(&all);
  ::sigemptyset(&blocked);
  for (const int cancels : {SIGINT, SIGTERM}) ::sigaddset(&blocked, cancels);
  ::posix_spawnattr_setsigdefault(&attributes, &all);
  ::posix_spawnattr_setsigmask(&attributes, &blocked);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  pid_t process = -1;
  const int error =
      ::posix_spawn(&process, arguments[0], &actions, &attributes, arguments.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
  return error == 0 ? process : -1;
}

using TakeLine = std::function<void(const std::string& line)>;

/// Child process: its output is passed on line by line until it ends; it is killed after the time
/// limit or when the job is stopped.
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

  /// Returns false if the child is silent for `seconds`. A line without an end is dropped: the
  /// child crashed while it wrote.
  bool listen(double seconds, const TakeLine& take, const Job& job) {
    const auto now = [] { return std::chrono::steady_clock::now(); };
    const std::chrono::duration<double> allowed(seconds);
    auto end = now() + allowed;
    std::vector<char> buffer(std::size_t{1} << 16);
    std::string begun;
    while (now() < end) {
      job.throwIfCancelled();
      pollfd waiting{pipe_, POLLIN, 0};
      constexpr int kMilliseconds = 10;
      if (::poll(&waiting, 1, kMilliseconds) <= 0) continue;
      const ssize_t count = ::read(pipe_, buffer.data(), buffer.size());
      if (count == 0) return true;
      if (count < 0) continue;
      const auto stop = buffer.begin() + count;
      for (auto from = buffer.begin();;) {
        const auto to = std::find(from, stop, '\n');
        begun.append(from, to);
        if (to == stop) break;
        take(begun);
        begun.clear();
        from = to + 1;
      }
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

 private:
  pid_t process_;
  int pipe_;
};

/// Reading of one file by the program.
class Reading {
 public:
  Reading(const std::filesystem::path& path, const std::string& text, double seconds,
          const Job& job)
      : source_(path.string()), text_(text), seconds_(seconds), job_(job) {}

  /// Runs the program and passes its results to `take`. Returns the error if it crashed or took too
  /// long; throws the error that it found.
  std::optional<ModelingError> run(const CadRequest& request, const TakeAnswer& take) const {
    const std::filesystem::path program = findProgram(source_);
    std::array<int, 2> ends{-1, -1};
    const Descriptor input(fileInMemory(text_));
    if (input.number() < 0 || ::pipe2(ends.data(), O_CLOEXEC) != 0)
      throw ModelingError(
          source_ + ": not enough memory or pipes for " + kProgram + "; close other programs",
          ModelingError::Kind::kIo);
    Descriptor output(ends[1]);
    const pid_t process = start({program.string(), std::to_string(::getpid()), numberText(seconds_),
                                 source_, toText(request)},
                                input.number(), output.number());
    output.close();
    Child child(process, ends[0]);
    if (process < 0)
      throw ModelingError(source_ + ": " + program.string() +
                              " could not be started; close other programs, or install Palpa again",
                          ModelingError::Kind::kIo);
    const bool hasEnded = child.listen(
        kPatience * seconds_, [&](const std::string& line) { answer(line, take); }, job_);
    const int status = hasEnded ? child.waitForEnd() : 0;
    job_.throwIfCancelled();
    if (!hasEnded || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)) return tookTooLong();
    if (!WIFEXITED(status) || WEXITSTATUS(status) != EXIT_SUCCESS) return crashed();
    return std::nullopt;
  }

  ModelingError crashed() const {
    return ModelingError(source_ +
                         ": OpenCASCADE crashes on the file; it is damaged: export it again, or in "
                         "another format");
  }

 private:
  void answer(const std::string& line, const TakeAnswer& take) const {
    CadAnswer answer = parse(line);
    if (const auto* progress = std::get_if<ReadProgress>(&answer))
      job_.report(progress->phase, progress->fraction);
    else if (auto* several = std::get_if<SolidsToChooseFrom>(&answer))
      throw SeveralBodies(source_ + ": ", std::move(several->found));
    else if (const auto* failed = std::get_if<ReadFailed>(&answer))
      throw ModelingError(failed->message, failed->kind);
    else
      take(std::move(answer));
  }

  CadAnswer parse(const std::string& line) const {
    try {
      return answerFrom(line);
    } catch (const ModelingError& error) {
      throw ModelingError(source_ + ": " + error.what());
    }
  }

  ModelingError tookTooLong() const {
    return ModelingError(source_ + ": OpenCASCADE needs longer than " + shortNumberText(seconds_) +
                             " s for the file; it is damaged or too complicated: simplify the "
                             "part, or export it in another format",
                         ModelingError::Kind::kTooLarge);
  }

  std::string source_;
  const std::string& text_;
  double seconds_;
  const Job& job_;
};

/// The result of a request for a single one.
template <class Result>
Result resultOf(const Reading& reading, const CadRequest& request) {
  std::optional<Result> result;
  const auto failure = reading.run(request, [&](CadAnswer answer) {
    if (auto* found = std::get_if<Result>(&answer)) result = std::move(*found);
  });
  if (failure) throw *failure;
  if (!result) throw reading.crashed();
  return std::move(*result);
}

}  // namespace

ImportedBody importInSandbox(const std::filesystem::path& path, const std::string& text,
                             const ImportOptions& options, double seconds, const Job& job) {
  return resultOf<ImportedBody>({path, text, seconds, job}, {.options = options});
}

FileBodies listInSandbox(const std::filesystem::path& path, const std::string& text,
                         ListedSurface surface, double seconds, const Job& job) {
  return resultOf<FileBodies>({path, text, seconds, job}, {.lists = true, .surface = surface});
}

void importBehindCrashes(std::size_t count, const RunFrom& run, const TakeBody& take) {
  for (std::size_t first = 0; first < count;) {
    std::optional<std::size_t> unfinished;
    const auto failure = run(first, [&](CadAnswer answer) {
      if (const auto* begun = std::get_if<SolidBegun>(&answer)) unfinished = begun->index;
      auto* ended = std::get_if<SolidEnded>(&answer);
      if (!ended) return;
      unfinished.reset();
      if (ended->index < count) take(ended->index, std::move(ended->outcome));
    });
    if (!failure) return;
    if (!unfinished || *unfinished >= count) throw *failure;
    take(*unfinished, {std::nullopt, failure->what()});
    first = *unfinished + 1;
  }
}

void importAllInSandbox(const std::filesystem::path& path, const std::string& text,
                        std::size_t count, const ImportOptions& options, const TakeBody& take,
                        double seconds, const Job& job) {
  // A run after a crash reads the file again from the beginning: its progress would fall.
  const Job quiet{job.stop, {}, job.threads};
  const auto run = [&](std::size_t first, const TakeAnswer& takeAnswer) {
    const Reading reading(path, text, seconds, first == 0 ? job : quiet);
    return reading.run({.allFrom = first, .options = options}, takeAnswer);
  };
  importBehindCrashes(count, run, take);
}

}  // namespace palpa::modeling
