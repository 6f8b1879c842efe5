#pragma once

#include <cstdint>
#include <string>

namespace palpa::modeling {

/// Identity of a process, different for later processes with the same number and for processes of
/// other machines.
struct ProcessId {
  int number = 0;
  std::uint64_t start =
      0;                ///< clock ticks from the start of the machine to the start of the process
  std::string boot;     ///< identity of the machine's start, new with every start
  std::string machine;  ///< identity of the machine; empty if it has none
};

ProcessId thisProcess();

/// True while a process runs, false after it has ended. Processes of other machines (in a home
/// folder on the network) count as running, because their state is unknown here.
bool isRunning(const ProcessId& process);

}  // namespace palpa::modeling
