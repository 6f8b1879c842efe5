#pragma once

#include "app/core/live/touch_loop.h"

namespace palpa::bench {

/// Prints the parts of the time between input and force: quantiles and a histogram, one column per
/// part.
void printLatencies(const app::TouchLoop::Latencies& latencies);

}  // namespace palpa::bench
