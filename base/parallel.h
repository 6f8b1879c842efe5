#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "base/job.h"

namespace palpa {

/// Number of worker threads for `job`, at least 1.
int workerCount(const Job& job);

/// Calls `body(index)` for every index in [0, count) on the job's threads, the calling thread
/// included, and returns when all are done. Indices are handed out one at a time, so each should be
/// worth ≥ 50 µs and ≤ 20 ms. Throws Cancelled if the job was stopped, or the first exception of a
/// body. Results do not depend on the number of threads if bodies write to separate memory.
/// Progress is reported under `phase`, if there is one.
void parallelFor(std::ptrdiff_t count, const Job& job, std::optional<Phase> phase,
                 const std::function<void(std::ptrdiff_t)>& body);
inline void parallelFor(std::ptrdiff_t count, const Job& job,
                        const std::function<void(std::ptrdiff_t)>& body) {
  parallelFor(count, job, std::nullopt, body);
}

}  // namespace palpa
