#pragma once

#include <functional>

#include "app/core/live/touch_stepper.h"
#include "base/job.h"

namespace palpa::app {

/// Does again what was recorded, without a clock: `seen` gets the snapshot after every step (of
/// which time and rate say nothing). On the model that was touched, from the beginning of its
/// touches on, these are the forces of the recording, bit for bit, if the live loop had to wait for
/// no columns; and the same on any number of threads. Missing columns are computed, so `body` must
/// not be that of a running loop. Progress: "replay". Throws Cancelled.
void replay(std::shared_ptr<const TouchableModel> body, const TouchRecording& recording,
            const Job& job, const std::function<void(const TouchSnapshot&)>& seen);

}  // namespace palpa::app
