#include "app/core/live/touch_replay.h"

namespace palpa::app {

void replay(const std::shared_ptr<const TouchableModel>& model, const TouchRecording& recording,
            const Job& job, const std::function<void(const TouchSnapshot&)>& seen) {
  bem::GreensColumns& columns = *model->columns();
  const std::vector<Eigen::Vector3d>& places = model->surface().places();
  TouchStepper stepper(model);
  Job columnsJob = job;
  columnsJob.progress = nullptr;
  TouchSnapshot snapshot;
  auto entry = recording.entries.begin();
  for (std::uint64_t step = 0; step < recording.steps; ++step) {
    job.throwIfCancelled();
    for (; entry != recording.entries.end() && entry->step <= step; ++entry)
      stepper.apply(entry->command);
    while (!stepper.missing().empty()) columns.computeAround(stepper.missing(), places, columnsJob);
    stepper.step();
    stepper.describe(snapshot);
    snapshot.step = step + 1;
    seen(snapshot);
    job.report(Phase::kReplay,
               static_cast<double>(step + 1) / static_cast<double>(recording.steps));
  }
}

}  // namespace palpa::app
