#include "app/core/system/destroy_in_background.h"

#include <utility>

#include "app/core/system/priority.h"
#include "base/worker_thread.h"

namespace palpa::app {
namespace {

WorkerThread& worker() {
  static WorkerThread single(lowerThreadPriority);
  return single;
}

}  // namespace

void destroyInBackground(std::shared_ptr<const void> held) {
  // The worker destroys the task, and with it what it holds.
  if (held) worker().post([held = std::move(held)](const std::stop_token&) {});
}

void waitUntilDestroyed() {
  worker().waitUntilIdle();
}

}  // namespace palpa::app
