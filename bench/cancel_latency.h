#pragma once

#include <vector>

#include "base/phase.h"
#include "modeling/project/project.h"

namespace palpa::bench {

struct CancelLatency {
  Phase phase;
  double seconds;  ///< from the request to the return, the maximum over all tries
};

/// Builds the model once, then repeatedly, each time stopped at another moment of another phase.
std::vector<CancelLatency> measureCancel(const modeling::Project& project, int threads,
                                         int stopsPerPhase);

}  // namespace palpa::bench
