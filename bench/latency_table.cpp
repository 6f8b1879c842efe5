#include "bench/latency_table.h"

#include <array>
#include <cstdio>
#include <utility>

namespace palpa::bench {

void printLatencies(const app::TouchLoop::Latencies& latencies) {
  using app::Latency;
  const std::array<std::pair<const char*, const Latency*>, 5> parts{
      {{"in all", &latencies.all},
       {"wait", &latencies.untilTaken},
       {"step", &latencies.step},
       {"publish", &latencies.publishing},
       {"woken late", &latencies.lateness}}};
  const auto row = [&](const char* name, const auto& value) {
    std::printf("%-12s", name);
    for (const auto& part : parts) std::printf(" %11.3f", value(*part.second));
    std::printf("\n");
  };
  std::printf("%-12s", "ms");
  for (const auto& part : parts) std::printf(" %11s", part.first);
  std::printf("\n");
  row("50 %", [](const Latency& latency) { return 1e3 * latency.p50; });
  row("99 %", [](const Latency& latency) { return 1e3 * latency.p99; });
  row("99.9 %", [](const Latency& latency) { return 1e3 * latency.p999; });
  row("largest", [](const Latency& latency) { return 1e3 * latency.largest; });
  for (std::size_t k = 0; k < Latency::kEnds.size() + 1; ++k) {
    const bool isLast = k == Latency::kEnds.size();
    std::printf("%s %-10.3g", isLast ? "> " : "<=", 1e3 * Latency::kEnds[isLast ? k - 1 : k]);
    for (const auto& part : parts)
      std::printf(" %11llu", static_cast<unsigned long long>(part.second->classes[k]));
    std::printf("\n");
  }
}

}  // namespace palpa::bench
