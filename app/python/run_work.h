#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <utility>

#include "base/job.h"

namespace palpa::python {

/// Runs long work on a second thread while the calling thread waits without the interpreter's lock,
/// so that other Python threads go on. Every 10 ms the calling thread takes the lock to let Python
/// handle signals: KeyboardInterrupt, or whatever a handler raises, stops the work and is raised
/// here when the work has ended, at most 20 ms later (Job::stop).
///
/// `progress`: None, or a callable with the name of the phase and the done fraction 0 … 1, called
/// on the calling thread, at least once per phase. If it returns False, the work is stopped and
/// Cancelled is thrown; an exception that it raises stops the work, too. `threads`: of the work; 0:
/// all cores. Rethrows what `work` throws. `work` must not use Python objects.
void runWork(const pybind11::object& progress, int threads,
             const std::function<void(const Job&)>& work);

/// The same for work with a result.
template <class Result>
Result computed(const pybind11::object& progress, int threads,
                const std::function<Result(const Job&)>& work) {
  std::optional<Result> result;
  runWork(progress, threads, [&](const Job& job) { result.emplace(work(job)); });
  return std::move(*result);
}

}  // namespace palpa::python
