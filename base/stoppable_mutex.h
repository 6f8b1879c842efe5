#pragma once

#include <condition_variable>
#include <mutex>
#include <stop_token>

#include "base/job.h"

namespace palpa {

/// A mutex for which a thread can stop waiting. For locks that are held for long, as it is slower
/// than std::mutex.
class StoppableMutex {
 public:
  void lock() { lock(std::stop_token()); }
  /// Throws Cancelled if a stop is requested before the mutex is free.
  void lock(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    if (!unlocked_.wait(lock, stop, [this] { return !isLocked_; })) throw Cancelled();
    isLocked_ = true;
  }
  void unlock() {
    {
      const std::lock_guard lock(mutex_);
      isLocked_ = false;
    }
    unlocked_.notify_one();
  }

 private:
  std::mutex mutex_;  // held for a moment only
  std::condition_variable_any unlocked_;
  bool isLocked_ = false;
};

}  // namespace palpa
