#pragma once

#include "app/core/live/touch_loop.h"

namespace palpa::bench {

/// Prints from where to where the time between input and force goes: quantiles and a histogram, one
/// column per part.
void printLatencies(const app::TouchLoop::Latencies& latencies);

}  // namespace palpa::bench
