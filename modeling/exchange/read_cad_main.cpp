// palpa-read-cad PARENT SECONDS NAME REQUEST: reads the CAD file NAME, with its content on standard
// input, in a separate process. The exit status is 0, or kSandboxFailed plus the kind of the error,
// whose message goes to standard output, or kSandboxSeveral; or the program crashes. A list of
// bodies and the outcome of each of several solids also go to standard output. Started by
// readInSandbox() and readAllInSandbox().
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
#include <string_view>

#include "modeling/error.h"
#include "modeling/exchange/cad_body.h"
#include "modeling/exchange/opencascade_session.h"
#include "modeling/exchange/sandboxed_read.h"

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

/// Descriptor for the message: the original standard output. From now on standard output goes
/// nowhere, because OpenCASCADE's reader of BREP files prints there.
int keepOutput() {
  const int output = ::dup(STDOUT_FILENO);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  if (nowhere >= 0) ::dup2(nowhere, STDOUT_FILENO);
  return output;
}

void tell(int output, std::string_view message) {
  while (!message.empty()) {
    const ssize_t count = ::write(output, message.data(), message.size());
    if (count <= 0) return;
    message.remove_prefix(static_cast<std::size_t>(count));
  }
}

/// Each solid gets the whole processor time.
void readAll(int output, const char* path, const std::string& text,
             const palpa::modeling::CadRequest& request, double seconds) {
  using namespace palpa::modeling;
  const auto wants = [&](std::size_t index) {
    if (index < *request.allFrom) return false;
    limitTime(seconds);
    tell(output, beginText(index));
    return true;
  };
  const auto take = [&](std::size_t index, const BodyOutcome& outcome) {
    tell(output, endText(index, outcome.problem));
  };
  readCadBodies(path, text, request.options, wants, take, palpa::Job{});
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
  const int output = keepOutput();
  try {
    const CadRequest request = requestFrom(arguments[4]);
    const std::string text{std::istreambuf_iterator<char>(std::cin), {}};
    const OpenCascadeSession session;
    if (request.lists)
      tell(output, toText(listCadBodies(arguments[3], text, request.surface, palpa::Job{})));
    else if (request.allFrom)
      readAll(output, arguments[3], text, request, seconds);
    else
      readCadBody(arguments[3], text, request.options, palpa::Job{});
  } catch (const SeveralBodies& several) {
    tell(output, toText(several.found()));
    std::_Exit(kSandboxSeveral);
  } catch (const ModelingError& error) {
    tell(output, error.what());
    std::_Exit(kSandboxFailed + static_cast<int>(error.kind()));
  } catch (...) {
    std::_Exit(EXIT_FAILURE);
  }
  std::_Exit(EXIT_SUCCESS);  // without destructors, because nothing is needed any more
}
