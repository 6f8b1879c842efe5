#include "base/worker_thread.h"

#include <utility>

#include "base/unexpected.h"

namespace palpa {

WorkerThread::~WorkerThread() {
  std::deque<Task> dropped;  // destroyed without the lock
  const std::lock_guard lock(mutex_);
  isClosing_ = true;
  dropped.swap(waiting_);
  running_.request_stop();
}

void WorkerThread::post(Task task) {
  const std::lock_guard lock(mutex_);
  add(std::move(task));
}

void WorkerThread::replace(Task task) {
  std::deque<Task> dropped;
  const std::lock_guard lock(mutex_);
  dropped.swap(waiting_);
  running_.request_stop();
  add(std::move(task));
}

void WorkerThread::cancel() {
  std::deque<Task> dropped;
  const std::lock_guard lock(mutex_);
  dropped.swap(waiting_);
  running_.request_stop();
  if (!isBusy_) idle_.notify_all();
}

void WorkerThread::waitUntilIdle() {
  std::unique_lock lock(mutex_);
  idle_.wait(lock, [this] { return waiting_.empty() && !isBusy_; });
}

void WorkerThread::add(Task task) {
  if (isClosing_) return;
  waiting_.push_back(std::move(task));
  if (!thread_.joinable())
    thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
  wake_.notify_one();
}

void WorkerThread::work(const std::stop_token& stop) {
  if (prepare_) prepare_();
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, stop, [this] { return !waiting_.empty(); })) {
    Task task = std::move(waiting_.front());
    waiting_.pop_front();
    running_ = std::stop_source();
    const std::stop_token token = running_.get_token();
    isBusy_ = true;
    lock.unlock();
    try {
      task(token);
    } catch (...) {
      reportUnexpected();
    }
    task = nullptr;  // destroyed without the lock
    lock.lock();
    isBusy_ = false;
    if (waiting_.empty()) idle_.notify_all();
  }
}

bool sleepUntil(std::chrono::steady_clock::time_point time, const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any stopped;
  std::unique_lock lock(mutex);
  return !stopped.wait_until(lock, stop, time, [&] { return stop.stop_requested(); });
}

}  // namespace palpa
