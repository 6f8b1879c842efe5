#pragma once

#include <functional>
#include <string>

#include "modeling/job.h"

namespace palpa::modeling {

/// Runs `work` in a child process first, a copy of this one without output, and throws when it does
/// not end well there: OpenCASCADE's readers crash, hang or take all memory on some damaged files,
/// and no check of ours can foresee every case. The child's result is dropped; what succeeded there
/// succeeds here as well, because the work is deterministic.
///
/// `work` must not need other threads. Stopping the job stops the child within 20 ms, whatever it
/// does.
/// @throws ModelingError: the one that `work` throws; or one that begins with `source` when the
/// child
///         crashed, used the processor for longer than `seconds`, or could not be started.
///         Cancelled.
void rehearse(const std::function<void()>& work, const std::string& source, double seconds,
              const Job& job);

}  // namespace palpa::modeling
