#pragma once
#include <string>

namespace palpa::app {

/// Memory that can still be taken without swapping, bytes; 0 when the system does not say.
double availableMemory();
/// Largest resident size of this process so far, bytes.
double peakMemory();
/// "1.4 GiB", "236 MiB".
std::string formatBytes(double bytes);

}  // namespace palpa::app
