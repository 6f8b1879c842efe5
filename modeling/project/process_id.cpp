#include "modeling/project/process_id.h"

#include <unistd.h>

#include <fstream>
#include <optional>
#include <sstream>

namespace palpa::modeling {
namespace {

std::string firstLine(const char* path) {
  std::string line;
  std::ifstream file(path);
  std::getline(file, line);
  return line;
}

/// Start of a process: field 22 of /proc/<number>/stat. None if there is no such process or it has
/// ended and only waits for its parent.
std::optional<std::uint64_t> startOf(int number) {
  std::ifstream file("/proc/" + std::to_string(number) + "/stat");
  std::string line;
  if (!std::getline(file, line)) return std::nullopt;
  // The second field is the program's name in parentheses, which may contain anything.
  std::istringstream rest(line.substr(line.rfind(')') + 1));
  std::string state;
  rest >> state;
  if (state == "Z" || state == "X") return std::nullopt;
  std::string skipped;
  for (int field = 4; field < 22; ++field) rest >> skipped;
  std::uint64_t start = 0;
  rest >> start;
  return start;
}

}  // namespace

ProcessId thisProcess() {
  const int number = ::getpid();
  return {number, startOf(number).value_or(0), firstLine("/proc/sys/kernel/random/boot_id"),
          firstLine("/etc/machine-id")};
}

bool isRunning(const ProcessId& process) {
  const ProcessId self = thisProcess();
  if (process.machine != self.machine) return true;
  return process.boot == self.boot && startOf(process.number) == process.start;
}

}  // namespace palpa::modeling
