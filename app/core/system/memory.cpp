#include "app/core/system/memory.h"

#include <malloc.h>
#include <sys/resource.h>

#include <cstdio>
#include <fstream>

namespace palpa::app {

double availableMemory() {
  std::ifstream file("/proc/meminfo");
  std::string key, unit;
  double value = 0;
  while (file >> key >> value) {
    std::getline(file, unit);
    if (key == "MemAvailable:") return value * 1024;
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
  char text[32];
  if (bytes >= kGibibyte)
    std::snprintf(text, sizeof text, "%.3g GiB", bytes / kGibibyte);
  else
    std::snprintf(text, sizeof text, "%.0f MiB", bytes / kMebibyte);
  return text;
}

}  // namespace palpa::app
