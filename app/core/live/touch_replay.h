#pragma once

#include <functional>

#include "app/core/live/touch_stepper.h"
#include "base/job.h"

namespace palpa::app {

/// Replays a recording without a clock: `seen` gets the snapshot after every step (without time and
/// rate). On the recorded model, and if the recording starts before the first touch, the forces
/// equal the live forces bit for bit, provided that the live loop never waited for columns; they do
/// not depend on the number of threads. Computes missing columns; a running loop may use the same
/// model and takes advantage of them. Phase of progress: "replay". Throws Cancelled.
void replay(const std::shared_ptr<const TouchableModel>& model, const TouchRecording& recording,
            const Job& job, const std::function<void(const TouchSnapshot&)>& seen);

}  // namespace palpa::app
