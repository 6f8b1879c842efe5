#include "app/core/system/memory.h"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include "base/count_text.h"
#include "base/text.h"

namespace palpa::app {

namespace {

/// What the limit of the process (ulimit -v) leaves, bytes; infinite without a limit.
double addressSpaceLeft() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
    return std::numeric_limits<double>::infinity();
  double usedPages = 0;
  std::ifstream("/proc/self/statm") >> usedPages;
  const double used = usedPages * static_cast<double>(sysconf(_SC_PAGESIZE));
  return std::max(1.0, static_cast<double>(limit.rlim_cur) - used);
}

}  // namespace

double availableMemory() {
  std::ifstream file("/proc/meminfo");
  std::string key, unit;
  double value = 0;
  while (file >> key >> value) {
    std::getline(file, unit);
    if (key == "MemAvailable:") return std::min(value * 1024, addressSpaceLeft());
  }
  return 0;
}

double peakMemory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024;
}

void reuseFreedMemory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // the largest value glibc accepts
  mallopt(M_TRIM_THRESHOLD, 512 << 20);
#endif
}

std::string formatBytes(double bytes) {
  constexpr double kMebibyte = 1024.0 * 1024.0, kGibibyte = 1024.0 * kMebibyte;
  if (bytes >= 1000 * kGibibyte) return estimateText(bytes / kGibibyte) + " GiB";
  if (bytes >= kGibibyte) return roundedText(bytes / kGibibyte, 3) + " GiB";
  return countText(bytes / kMebibyte) + " MiB";
}

}  // namespace palpa::app
