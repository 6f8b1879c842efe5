#include "app/core/live/stiffness_worker.h"

#include <chrono>
#include <numeric>
#include <utility>

#include "app/core/system/priority.h"
#include "bem/contact/stiffness_map.h"

namespace palpa::app {
namespace {

/// Interval of the checks for new columns.
constexpr std::chrono::milliseconds kCheckInterval{300};

}  // namespace

std::vector<double> stiffnessMap(const std::shared_ptr<const TouchModel>& model, double radius,
                                 const Job& job) {
  const TouchableModel touchable(model);
  std::vector<int> all(static_cast<std::size_t>(touchable.surface().dofs().nodeCount()));
  std::iota(all.begin(), all.end(), 0);
  touchable.columns()->compute(all, job);
  bem::StiffnessMap map(touchable.surface(), radius);
  map.update(*touchable.columns(), job);
  return map.compliances();
}

StiffnessWorker::StiffnessWorker(std::function<void(Result)> receive)
    : receive_(std::move(receive)), worker_(lowerThreadPriority) {}

void StiffnessWorker::start(std::shared_ptr<const TouchableModel> model, double radius) {
  stop();
  worker_.post([this, model = std::move(model), radius](const std::stop_token& stop) {
    run(stop, model, radius);
  });
}

void StiffnessWorker::stop() {
  worker_.cancel();
  worker_.waitUntilIdle();
}

void StiffnessWorker::run(const std::stop_token& stop,
                          const std::shared_ptr<const TouchableModel>& model, double radius) const {
  Job job;
  job.stop = stop;
  job.threads = 1;  // the columns need the others
  bem::StiffnessMap map(model->surface(), radius);
  bool isFirst = true;
  do {
    try {
      // The first result may be empty: it tells that the computation has begun.
      if (map.update(*model->columns(), job) > 0 || isFirst) {
        isFirst = false;
        receive_(
            {model, radius, map.compliances(),
             map.nodeCount() > 0 ? static_cast<double>(map.readyCount()) / map.nodeCount() : 1.0});
      }
    } catch (const Cancelled&) {
      return;
    }
  } while (!map.isComplete() &&
           sleepUntil(std::chrono::steady_clock::now() + kCheckInterval, stop));
}

}  // namespace palpa::app
