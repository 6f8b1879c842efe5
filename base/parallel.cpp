#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace palpa {

int workerCount(const Job& job) {
  if (job.threads > 0) return job.threads;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void parallelFor(std::ptrdiff_t count, const Job& job, std::optional<Phase> phase,
                 const std::function<void(std::ptrdiff_t)>& body) {
  std::atomic<std::ptrdiff_t> next = 0;
  std::atomic<bool> failed = false;
  std::ptrdiff_t done = 0;
  std::exception_ptr firstError;
  std::mutex mutex;  // guards done, firstError and the progress sink

  const auto work = [&] {
    while (!failed && !job.stop.stop_requested()) {
      const std::ptrdiff_t index = next++;
      if (index >= count) return;
      try {
        body(index);
        const std::scoped_lock lock(mutex);
        ++done;
        if (phase) job.report(*phase, static_cast<double>(done) / static_cast<double>(count));
      } catch (...) {
        const std::scoped_lock lock(mutex);
        if (!firstError) firstError = std::current_exception();
        failed = true;
      }
    }
  };
  {
    std::vector<std::jthread> helpers;
    const auto wanted = std::min<std::ptrdiff_t>(workerCount(job), count) - 1;
    for (std::ptrdiff_t i = 0; i < wanted; ++i) helpers.emplace_back(work);
    work();
  }
  if (firstError) std::rethrow_exception(firstError);
  job.throwIfCancelled();
}

}  // namespace palpa
