#pragma once

#include <cstddef>
#include <functional>

#include "base/job.h"

namespace palpa {

/// Number of worker threads that `job` asks for, at least 1.
int workerCount(const Job& job);

/// Calls `body(index)` for every index in [0, count) on the job's threads, the calling thread
/// included, and returns when all are done. Indices are handed out one at a time, so each should be
/// worth ≥ 50 µs and ≤ 20 ms. Throws Cancelled when the job was stopped, or the first exception a
/// body threw. Results do not depend on the number of threads as long as bodies write to separate
/// places.
/// Progress is reported under `phase`; not at all if that is empty.
void parallelFor(std::ptrdiff_t count, const Job& job, std::string_view phase,
                 const std::function<void(std::ptrdiff_t)>& body);

}  // namespace palpa
