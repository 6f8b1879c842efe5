#include "app/core/system/destroy_in_background.h"

#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "app/core/system/priority.h"

namespace palpa::app {
namespace {

class Releaser {
 public:
  Releaser() : worker_([this](const std::stop_token& stop) { work(stop); }) {}

  void add(std::shared_ptr<const void> held) {
    {
      const std::lock_guard lock(mutex_);
      waiting_.push_back(std::move(held));
    }
    wake_.notify_one();
  }

  void wait() {
    std::unique_lock lock(mutex_);
    idle_.wait(lock, [&] { return waiting_.empty() && !isBusy_; });
  }

 private:
  void work(const std::stop_token& stop) {
    lowerThreadPriority();
    std::unique_lock lock(mutex_);
    while (wake_.wait(lock, stop, [&] { return !waiting_.empty(); })) {
      auto now = std::exchange(waiting_, {});
      isBusy_ = true;
      lock.unlock();
      now.clear();
      lock.lock();
      isBusy_ = false;
      idle_.notify_all();
    }
  }

  std::mutex mutex_;  // guards all but the worker
  std::condition_variable_any wake_;
  std::condition_variable idle_;
  std::vector<std::shared_ptr<const void>> waiting_;
  bool isBusy_ = false;
  std::jthread worker_;  // last: it uses all of the above
};

Releaser& releaser() {
  static Releaser single;
  return single;
}

}  // namespace

void destroyInBackground(std::shared_ptr<const void> held) {
  if (held) releaser().add(std::move(held));
}

void waitUntilReleased() {
  releaser().wait();
}

}  // namespace palpa::app
