#pragma once

#include <cstddef>

#include "base/job.h"

namespace palpa {

/// A part of a job: the same stop token and threads; its progress from 0 to 1 is reported as
/// fractions from `begin` to `end` of the whole.
inline Job partOfJob(const Job& job, double begin, double end) {
  Job part = job;
  if (job.progress)
    part.progress = [progress = job.progress, begin, end](Phase phase, double fraction) {
      progress(phase, begin + fraction * (end - begin));
    };
  return part;
}

/// The part that does items `first` to `end` of `all`.
inline Job partOfJob(const Job& job, std::size_t first, std::size_t end, std::size_t all) {
  const auto whole = static_cast<double>(all);
  return partOfJob(job, static_cast<double>(first) / whole, static_cast<double>(end) / whole);
}

}  // namespace palpa
