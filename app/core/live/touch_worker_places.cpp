// Forces of new places of large models, before their columns.
#include "app/core/live/touch_worker.h"

namespace palpa::app {

using Effort = bem::ReferenceProblem::Effort;

bool TouchWorker::answersPlaces(const TouchableModel& model) const {
  return model.columns()->rows() >= options_.answersPlacesFrom;
}

/// Solves for the place of a request. kNone: its columns are needed.
TouchWorker::Answer TouchWorker::answerPlace(const std::shared_ptr<const TouchableModel>& model,
                                             const ColumnRequest& request,
                                             const std::stop_token& stop) {
  bem::GreensColumns& columns = *model->columns();
  if (!request.isOfPlace || !answersPlaces(*model)) return Answer::kNone;
  bem::ContactMask mask;
  const auto workspace = model->surface().makeWorkspace();
  if (!model->surface().makeMask(request.place.point, request.place.radius, *workspace, mask))
    return Answer::kNone;
  if (columns.responses().find(mask.point, mask.radius)) return Answer::kKnown;
  if (columns.responses().isFull()) return Answer::kNone;
  stopFiller();
  const std::lock_guard lock(computing_);
  Job job;
  job.stop = stop;
  job.threads = options_.threads;
  // Rough only if the other thread will improve it.
  columns.computeResponse(mask.point, mask.radius, mask.nodes, mask.traction, job,
                          isFilled(request.number) ? Effort::kRough : Effort::kFast);
  const auto* response = columns.responses().find(mask.point, mask.radius);
  if (response && response->isRough) {
    const std::lock_guard places(mutex_);
    rough_.push_back({model, mask.point, mask.radius});
  }
  return Answer::kComputed;
}

/// The filler pauses, and computes its present block again later.
void TouchWorker::stopFiller() {
  isUrgent_.store(true);
  const std::lock_guard lock(mutex_);
  fillerBlock_.request_stop();
}

/// Computes rough columns of some nodes without any.
void TouchWorker::computeRough(const TouchableModel& model, std::span<const int> nodes,
                               const std::stop_token& stop) {
  stopFiller();
  const std::lock_guard lock(computing_);
  Job job;
  job.stop = stop;
  job.threads = options_.threads;
  model.columns()->computeRough(nodes, job);
}

/// Solves again for the oldest place with a rough response. False: there is none.
bool TouchWorker::improvePlace(const std::stop_token& stop) {
  RoughPlace place;
  std::shared_ptr<const TouchableModel> model;
  {
    const std::lock_guard lock(mutex_);
    while (!model && !rough_.empty()) {
      place = rough_.front();
      rough_.erase(rough_.begin());
      model = place.model.lock();
    }
  }
  bem::ContactMask mask;
  if (!model || !model->surface().makeMask(place.point, place.radius,
                                           *model->surface().makeWorkspace(), mask))
    return false;
  Job job;
  job.stop = stop;
  job.threads = options_.threads;
  const std::lock_guard lock(computing_);
  try {
    model->columns()->computeResponse(place.point, place.radius, mask.nodes, mask.traction, job,
                                      Effort::kFast);
  } catch (const Cancelled&) {  // for a new place, or at the end
    const std::lock_guard places(mutex_);
    rough_.insert(rough_.begin(), place);
  }
  return true;
}

}  // namespace palpa::app
