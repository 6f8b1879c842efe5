#include "app/core/live/stiffness_worker.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <numeric>
#include <stop_token>
#include <utility>

#include "app/core/system/priority.h"
#include "bem/contact/stiffness_map.h"

namespace palpa::app {
namespace {

/// Between two looks at which columns have come.
constexpr std::chrono::milliseconds kLook{300};

}  // namespace

std::vector<double> stiffnessMap(const std::shared_ptr<const TouchModel>& model, double radius,
                                 const Job& job) {
  const TouchableModel body(model);
  std::vector<int> all(static_cast<std::size_t>(body.surface().dofs().nodeCount()));
  std::iota(all.begin(), all.end(), 0);
  body.columns()->compute(all, job);
  bem::StiffnessMap map(body.surface(), radius);
  map.update(*body.columns(), job);
  return map.compliances();
}

void StiffnessWorker::start(std::shared_ptr<const TouchableModel> body, double radius) {
  stop();
  thread_ = std::jthread([this, body = std::move(body), radius](const std::stop_token& stop) {
    run(stop, body, radius);
  });
}

void StiffnessWorker::stop() {
  thread_ = {};  // asks it to stop and waits
}

void StiffnessWorker::run(const std::stop_token& stop,
                          const std::shared_ptr<const TouchableModel>& body, double radius) const {
  lowerThreadPriority();
  Job job;
  job.stop = stop;
  job.threads = 1;  // the columns need the others
  bem::StiffnessMap map(body->surface(), radius);
  std::mutex mutex;
  std::condition_variable_any sleep;
  bool isFirst = true;
  while (!stop.stop_requested()) {
    try {
      // The first time also when there is nothing: to say that it has begun.
      if (map.update(*body->columns(), job) > 0 || isFirst) {
        isFirst = false;
        receive_(
            {body, radius, map.compliances(),
             map.nodeCount() > 0 ? static_cast<double>(map.readyCount()) / map.nodeCount() : 1.0});
      }
    } catch (const Cancelled&) {
      return;
    }
    if (map.isComplete()) return;
    std::unique_lock lock(mutex);
    sleep.wait_for(lock, stop, kLook, [] { return false; });
  }
}

}  // namespace palpa::app
