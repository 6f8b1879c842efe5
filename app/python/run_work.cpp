#include "app/python/run_work.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace palpa::python {
namespace {

namespace py = pybind11;

constexpr std::chrono::milliseconds kPoll{10};

/// What the working thread tells the waiting one.
class Messages {
 public:
  struct Report {
    Phase phase;
    double fraction;
  };

  /// Of a phase, only the newest report is kept.
  void report(Phase phase, double fraction) {
    const std::scoped_lock lock(mutex_);
    if (!reports_.empty() && reports_.back().phase == phase)
      reports_.back().fraction = fraction;
    else
      reports_.push_back({phase, fraction});
  }

  void finish() {
    const std::scoped_lock lock(mutex_);
    isDone_ = true;
    changed_.notify_one();
  }

  /// Waits until the work is done, at most kPoll. Returns true if it is done.
  bool wait(std::vector<Report>& reports) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, kPoll, [this] { return isDone_; });
    reports.clear();
    std::swap(reports, reports_);
    return isDone_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Report> reports_;
  bool isDone_ = false;
};

/// Thread that is asked to stop, and waited for without the interpreter's lock, in any case.
class Worker {
 public:
  Worker(Messages& messages, bool wantsProgress, int threads,
         const std::function<void(const Job&)>& work)
      : job_{stop_.get_token(), {}, threads} {
    if (wantsProgress)
      job_.progress = [&messages](Phase phase, double fraction) {
        messages.report(phase, fraction);
      };
    thread_ = std::thread([this, &messages, &work] {
      try {
        work(job_);
      } catch (...) {
        failure_ = std::current_exception();
      }
      messages.finish();
    });
  }
  ~Worker() {
    if (!thread_.joinable()) return;
    stop();
    join();
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  void stop() { stop_.request_stop(); }
  void join() {
    const py::gil_scoped_release released;
    thread_.join();
  }
  const std::exception_ptr& failure() const { return failure_; }

 private:
  std::stop_source stop_;
  Job job_;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace

void runWork(const py::object& progress, int threads, const std::function<void(const Job&)>& work) {
  const bool wantsProgress = !progress.is_none();
  Messages messages;
  Worker worker(messages, wantsProgress, threads, work);
  std::vector<Messages::Report> reports;
  bool isDone = false;
  while (!isDone) {
    {
      const py::gil_scoped_release released;
      isDone = messages.wait(reports);
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    for (const Messages::Report& report : reports) {
      const py::object answer = progress(std::string(nameOf(report.phase)), report.fraction);
      if (answer.is(py::bool_(false))) {
        if (isDone) throw Cancelled{};
        worker.stop();
      }
    }
  }
  worker.join();
  if (worker.failure()) std::rethrow_exception(worker.failure());
}

}  // namespace palpa::python
