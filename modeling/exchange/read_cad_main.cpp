// palpa-read-cad PARENT SECONDS NAME REQUEST: reads the CAD file NAME, with its content on standard
// input, in a separate process, and writes the messages of cad_answer.h to standard output. The
// exit status is 0 unless the program crashes. Started by the functions of sandboxed_read.h.
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "modeling/error.h"
#include "modeling/exchange/cad_answer.h"
#include "modeling/exchange/cad_body.h"
#include "modeling/exchange/cad_request.h"
#include "modeling/exchange/opencascade_session.h"

namespace {

constexpr rlim_t kMemory = rlim_t{8} << 30;  // bytes in addition to the current memory
constexpr int kArguments = 4;

/// Limits the processor time to `seconds` from now on.
void limitTime(double seconds) {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  const auto whole = static_cast<rlim_t>(std::ceil(seconds)) +
                     static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec);
  rlimit time{};
  ::getrlimit(RLIMIT_CPU, &time);  // the hard limit may not be raised again
  time.rlim_cur = std::min(whole, time.rlim_max);
  ::setrlimit(RLIMIT_CPU, &time);
}

void setLimits(double seconds) {
  long pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t bytes = static_cast<rlim_t>(pages) * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
  rlimit limit{};
  ::getrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = std::min(limit.rlim_max, bytes + kMemory);
  ::setrlimit(RLIMIT_AS, &limit);
  limitTime(seconds);
  const rlimit noCore{0, 0};
  ::setrlimit(RLIMIT_CORE, &noCore);
}

/// Descriptor for the answer: the original standard output. From now on standard output goes
/// nowhere, because OpenCASCADE's reader of BREP files prints there.
int keepOutput() {
  const int output = ::dup(STDOUT_FILENO);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  if (nowhere >= 0) ::dup2(nowhere, STDOUT_FILENO);
  return output;
}

class Answers {
 public:
  explicit Answers(int output) : output_(output) {}

  void tell(const palpa::modeling::CadAnswer& answer) const {
    const std::string line = toLine(answer);
    std::string_view rest = line;
    while (!rest.empty()) {
      const ssize_t count = ::write(output_, rest.data(), rest.size());
      if (count <= 0) return;
      rest.remove_prefix(static_cast<std::size_t>(count));
    }
  }

  /// Progress in steps of a per cent.
  void progress(palpa::Phase phase, double fraction) {
    constexpr double kStep = 0.01;
    if (phase == phase_ && fraction < fraction_ + kStep && fraction < 1.0) return;
    phase_ = phase;
    fraction_ = fraction;
    tell(palpa::modeling::ReadProgress{phase, fraction});
  }

 private:
  int output_;
  std::optional<palpa::Phase> phase_;
  double fraction_ = 0.0;
};

/// Each solid gets the whole processor time.
void readAll(Answers& answers, const char* path, const std::string& text,
             const palpa::modeling::CadRequest& request, double seconds, const palpa::Job& job) {
  using namespace palpa::modeling;
  const auto wants = [&](std::size_t index) {
    if (index < *request.allFrom) return false;
    limitTime(seconds);
    answers.tell(SolidBegun{index});
    return true;
  };
  const auto take = [&](std::size_t index, BodyOutcome outcome) {
    answers.tell(SolidEnded{index, std::move(outcome)});
  };
  readCadBodies(path, text, request.options, wants, take, job);
}

}  // namespace

int main(int count, char** arguments) {
  using namespace palpa::modeling;
  if (count != kArguments + 1) return EXIT_FAILURE;
  // Ends with its parent, also if the parent has already ended.
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != std::atoi(arguments[1])) return EXIT_FAILURE;
  const double seconds = std::atof(arguments[2]);
  setLimits(seconds);
  Answers answers(keepOutput());
  const palpa::Job job{
      {}, [&](palpa::Phase phase, double fraction) { answers.progress(phase, fraction); }};
  try {
    const CadRequest request = requestFrom(arguments[4]);
    const std::string text{std::istreambuf_iterator<char>(std::cin), {}};
    const OpenCascadeSession session;
    if (request.lists)
      answers.tell(listCadBodies(arguments[3], text, request.surface, job));
    else if (request.allFrom)
      readAll(answers, arguments[3], text, request, seconds, job);
    else
      answers.tell(readCadBody(arguments[3], text, request.options, job));
  } catch (const SeveralBodies& several) {
    answers.tell(SolidsToChooseFrom{several.found()});
  } catch (const ModelingError& error) {
    answers.tell(ReadFailed{error.what(), error.kind()});
  } catch (...) {
    std::_Exit(EXIT_FAILURE);
  }
  std::_Exit(EXIT_SUCCESS);  // without destructors, because nothing is needed any more
}
