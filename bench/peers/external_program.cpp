#include "bench/peers/external_program.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "bench/timing.h"

namespace palpa::bench {

std::string findProgram(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::string candidate = folder;
    candidate += '/';
    candidate += name;
    if (access(candidate.c_str(), X_OK) == 0) return candidate;
  }
  return {};
}

ProgramRun runProgram(const std::vector<std::string>& command, const std::filesystem::path& folder,
                      const std::string& log) {
  const std::string logPath = folder / log;
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ProgramRun run;
  int status = 0;
  rusage usage{};
  run.seconds = secondsFor([&] {
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("cannot start " + command.front());
    if (child == 0) {
      const int file = open(logPath.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      if (file >= 0 && dup2(file, 1) >= 0 && dup2(file, 2) >= 0 && chdir(folder.c_str()) == 0)
        execv(arguments.front(), arguments.data());
      _exit(127);
    }
    wait4(child, &status, 0, &usage);
  });
  run.peakBytes = 1024.0 * static_cast<double>(usage.ru_maxrss);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return run;
  std::ifstream file(logPath);
  const std::string said{std::istreambuf_iterator<char>(file), {}};
  throw std::runtime_error(command.front() + " failed: " +
                           said.substr(said.size() - std::min<std::size_t>(said.size(), 600)));
}

ExchangeFolder::ExchangeFolder() {
  std::string name = std::filesystem::temp_directory_path() / "palpa-peers-XXXXXX";
  if (!mkdtemp(name.data())) throw std::runtime_error("cannot make the folder " + name);
  path_ = name;
}

ExchangeFolder::~ExchangeFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace palpa::bench
