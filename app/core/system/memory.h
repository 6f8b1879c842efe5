#pragma once

#include <string>

namespace palpa::app {

/// Memory that can still be taken without swapping, bytes; 0 when the system does not say.
double availableMemory();
/// Largest resident size of this process so far, bytes.
double peakMemory();
/// Makes the allocator keep freed blocks of up to 32 MiB for the next request instead of returning
/// each to the system: a program that solves block after block otherwise spends half its time on
/// page faults. For `main` to call once; process-wide.
void reuseFreedMemory();
/// "1.4 GiB", "236 MiB".
std::string formatBytes(double bytes);

}  // namespace palpa::app
