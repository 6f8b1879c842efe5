#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

namespace palpa {

/// Thread that runs tasks one after the other, started by the first task. All functions may be
/// called from any thread, waitUntilIdle() and the destructor not from a task. An exception of a
/// task goes to reportUnexpected().
class WorkerThread {
 public:
  /// The token is triggered by cancel(), replace() and the destructor.
  using Task = std::function<void(const std::stop_token&)>;

  /// `prepare` runs on the thread before the first task, for instance to lower its priority.
  explicit WorkerThread(std::function<void()> prepare = {}) : prepare_(std::move(prepare)) {}
  /// Cancels all tasks, ignores tasks posted from now on, and waits for the running one.
  ~WorkerThread();
  WorkerThread(const WorkerThread&) = delete;
  WorkerThread& operator=(const WorkerThread&) = delete;

  /// Appends a task.
  void post(Task task);
  /// Cancels all tasks and appends this one. Does not wait.
  void replace(Task task);
  /// Drops the waiting tasks and asks the running one to stop. Does not wait.
  void cancel();
  /// Waits until no task runs or waits.
  void waitUntilIdle();

 private:
  void add(Task task);
  void work(const std::stop_token& stop);

  const std::function<void()> prepare_;
  std::mutex mutex_;  // guards everything below except the thread's function
  std::condition_variable_any wake_, idle_;
  std::deque<Task> waiting_;
  std::stop_source running_{std::nostopstate};  // of the running task
  bool isBusy_ = false, isClosing_ = false;
  std::jthread thread_;  // last: it uses all of the above
};

/// Sleeps until `time`. False, and earlier, if `stop` is triggered.
bool sleepUntil(std::chrono::steady_clock::time_point time, const std::stop_token& stop);

}  // namespace palpa
