#pragma once

#include <string>

namespace palpa::app {

/// Memory available without swapping and within the limit of the process (ulimit -v), bytes; 0 if
/// unknown.
double availableMemory();
/// Largest resident size of this process so far, bytes.
double peakMemory();
/// Makes the allocator keep freed blocks of up to 32 MiB for the next request instead of returning
/// them to the system: otherwise a program that solves many blocks spends half its time on page
/// faults. For `main` to call once; applies to the whole process.
void reuseFreedMemory();
/// "1.4 GiB", "236 MiB".
std::string formatBytes(double bytes);

}  // namespace palpa::app
