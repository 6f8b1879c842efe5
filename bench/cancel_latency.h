#pragma once

#include <string>
#include <vector>

#include "app/core/model/touch_model.h"

namespace palpa::bench {

struct CancelLatency {
  std::string phase;
  double seconds;  ///< from the request to the return, the longest of all tries
};

/// Builds the model once, then again and again, each time stopped at another moment of another
/// phase.
std::vector<CancelLatency> measureCancel(const modeling::Project& project, int threads,
                                         int stopsPerPhase);

}  // namespace palpa::bench
