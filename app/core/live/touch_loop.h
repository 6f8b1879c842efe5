#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>

#include "app/core/live/latency_histogram.h"
#include "app/core/live/touch_input.h"
#include "app/core/live/touch_worker.h"

namespace palpa::app {

/// The hand meets the body: a thread of its own that takes what mouse, script or device say, finds
/// the forces a thousand times a second, and sooner when something new is said (but at most every
/// half millisecond), and hands them out. Neither side waits for the other: input comes through one
/// place per contact in which the newest value wins, results go out through a triple buffer, and
/// the loop itself takes no lock and allocates nothing while contacts are moved (beginning and
/// ending one, and changing the model, may allocate).
///
/// The model may be replaced at any time. Contacts stay in place (ContactSimulation::takeOver); the
/// old model is touched until the new one has the columns that they need.
///
/// A contact belongs to the thread that began it; different threads may have different contacts.
/// All other functions may be called from any thread.
class TouchLoop {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::microseconds kPeriod{1000};    ///< between steps without new input
  static constexpr std::chrono::microseconds kMinPeriod{500};  ///< between steps with new input
  static constexpr const char* kThreadName = "palpa-touch";
  using Options = TouchWorker::Options;

  explicit TouchLoop(Options options = {});
  /// Waits for the step and the block of columns at hand.
  ~TouchLoop();
  TouchLoop(const TouchLoop&) = delete;
  TouchLoop& operator=(const TouchLoop&) = delete;

  /// What is to be touched from now on, as soon as it can be; returns the number by which snapshots
  /// call it. A model whose operators equal those before (its key() does) keeps the columns. Null:
  /// nothing; the contacts that were begun until now end, also when another model follows at once,
  /// the loop sleeps, and the columns are kept for the next model.
  std::uint64_t setModel(std::shared_ptr<const TouchModel> model);

  /// Begins a contact at the place nearest to `at` (mm, unloaded shape). For `value` see
  /// bem::ContactSimulation::begin(). Without a model it begins as soon as there is one. Throws
  /// TouchRefused: numbers that are not finite or out of range, more contacts than a snapshot
  /// holds.
  TouchId begin(const bem::ContactTool& tool, const Eigen::Vector3d& at,
                const Eigen::Vector3d& value) {
    return input_.begin(tool, at, value);
  }
  /// Moves it; values that are not finite, and contacts that have ended, are ignored.
  void set(TouchId id, const Eigen::Vector3d& value) { input_.set(id, value); }
  /// A contact that is never ended stays as a pin.
  void end(TouchId id) {
    input_.end(id);
    // Without a model the loop sleeps, and the contact's place is needed for others.
    LoopMailbox::signal(mail_.loopSignal);
  }

  /// Where the next touch may begin (mm): columns are computed around it.
  void expect(const Eigen::Vector3d& point);

  /// From set() to the snapshot with the force being published, of all values that were used.
  Latency latency() const { return latencies_.all.read(); }
  /// Its parts, one after the other, and how late the system wakes the loop.
  struct Latencies {
    Latency all;
    Latency untilTaken;  ///< from set() until the loop takes the value
    Latency step;        ///< until the forces are found, of those steps that had news
    Latency publishing;  ///< until the snapshot is published
    Latency lateness;    ///< of every wake-up, behind the time that was asked for
  };
  Latencies latencies() const {
    return {latencies_.all.read(), latencies_.untilTaken.read(), latencies_.step.read(),
            latencies_.publishing.read(), latencies_.lateness.read()};
  }
  void clearLatency() {
    for (auto* histogram : {&latencies_.all, &latencies_.untilTaken, &latencies_.step,
                            &latencies_.publishing, &latencies_.lateness})
      histogram->clear();
  }

  /// The newest snapshot.
  void read(TouchSnapshot& into) const;
  TouchWorker::Status status() const { return worker_.status(); }
  /// What a snapshot's `model` means; null when it is not touched any more.
  std::shared_ptr<const TouchableModel> body(std::uint64_t number) const {
    return worker_.body(number);
  }

  /// Records all input from now on, up to `most` commands (120 bytes each, reserved as addresses;
  /// the system gives memory for those that come, so the loop never allocates); contacts that are
  /// held already begin at step 0. A recording that runs already is given up.
  void startRecording(std::size_t most = 1U << 19U);
  /// What was recorded; empty when none runs.
  TouchRecording stopRecording();

 private:
  void run(const std::stop_token& stop);
  void waitUntil(Clock::time_point due, Clock::time_point earliest);
  void receiveModel();
  void swapIfReady();
  void retire(LoopMailbox::ReadyModel* offer);
  void takeInput();
  void takeRecorder();
  void apply(const TouchCommand& command);
  void record(const TouchCommand& command);
  void askForColumns();
  void publish();

  LoopMailbox mail_;
  TouchInput input_;
  mutable std::mutex readers_;  // among readers
  mutable TripleBuffer<TouchSnapshot> results_;

  struct Histograms {
    LatencyHistogram all, untilTaken, step, publishing, lateness;
  };
  Histograms latencies_;

  std::mutex recorderMutex_;  // among those who record
  bool isRecording_ = false;
  std::atomic<TouchRecording*> newRecording_{nullptr}, finished_{nullptr};
  std::atomic<bool> stopsRecording_{false};

  std::mutex hoverMutex_;  // between expect() and the worker
  Eigen::Vector3d hover_ = Eigen::Vector3d::Zero();
  bool hasHover_ = false;
  TouchSnapshot focusSnapshot_;  // of the worker's thread

  // Of the loop's thread.
  LoopMailbox::ReadyModel* touched_ = nullptr;
  LoopMailbox::ReadyModel* next_ = nullptr;
  int nextReady_ = -1, stepsSinceLook_ = 0;
  Clock::time_point began_, stepped_;  // of the last step
  std::unique_ptr<TouchRecording> recording_;
  std::uint64_t step_ = 0;
  Clock::time_point rateSince_;
  std::uint64_t rateStep_ = 0;
  double rate_ = 0;

  TouchWorker worker_;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace palpa::app
