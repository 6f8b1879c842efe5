// palpa-read-cad PARENT SECONDS NAME REQUEST: reads the CAD file NAME, with its content on standard
// input, in a separate process. The exit status is 0, or kSandboxFailed plus the kind of the error,
// whose message goes to standard output, or kSandboxSeveral; or the program crashes. A list of
// bodies also goes to standard output. Started by readInSandbox().
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

}  // namespace

int main(int count, char** arguments) {
  using namespace palpa::modeling;
  if (count != kArguments + 1) return EXIT_FAILURE;
  // Ends with its parent, also if the parent has already ended.
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != std::atoi(arguments[1])) return EXIT_FAILURE;
  setLimits(std::atof(arguments[2]));
  const int output = keepOutput();
  try {
    const CadRequest request = requestFrom(arguments[4]);
    const std::string text{std::istreambuf_iterator<char>(std::cin), {}};
    const OpenCascadeSession session;
    if (request.lists)
      tell(output, toText(listCadBodies(arguments[3], text, request.surface, palpa::Job{})));
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
