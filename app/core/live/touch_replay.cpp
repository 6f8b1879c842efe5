#include "app/core/live/touch_replay.h"

#include <utility>

namespace palpa::app {

void replay(std::shared_ptr<const TouchableModel> body, const TouchRecording& recording,
            const Job& job, const std::function<void(const TouchSnapshot&)>& seen) {
  bem::GreensColumns& columns = *body->columns();
  TouchStepper player(std::move(body));
  Job columnsJob = job;
  columnsJob.progress = nullptr;
  TouchSnapshot snapshot;
  auto entry = recording.entries.begin();
  for (std::uint64_t step = 0; step < recording.steps; ++step) {
    job.throwIfCancelled();
    for (; entry != recording.entries.end() && entry->step <= step; ++entry)
      player.apply(entry->command);
    while (!player.missing().empty()) columns.compute(player.missing(), columnsJob);
    player.step();
    player.describe(snapshot);
    snapshot.step = step + 1;
    seen(snapshot);
    job.report("replay", static_cast<double>(step + 1) / static_cast<double>(recording.steps));
  }
}

}  // namespace palpa::app
