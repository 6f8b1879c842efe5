#pragma once

#include <cstdint>
#include <string>

namespace palpa::modeling {

/// A process, told apart from later ones with the same number and from those of other machines.
struct ProcessId {
  int number = 0;
  std::uint64_t start = 0;  ///< clock ticks from the machine's start to the process's
  std::string boot;         ///< identity of the machine's start, new with every start
  std::string machine;      ///< identity of the machine; empty where it has none
};

ProcessId thisProcess();

/// False for a process that has ended, true while it runs. Processes of another machine (a home
/// folder on the network) count as running: nobody here can tell.
bool isRunning(const ProcessId& process);

}  // namespace palpa::modeling
