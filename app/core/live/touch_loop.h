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

/// Thread that turns input of mouse, script or device into contact forces, a thousand times a
/// second and, on new input, sooner (at most every half millisecond). Neither side waits for the
/// other: input goes through one slot per contact, in which the newest value wins; results go
/// through a triple buffer. The loop takes no lock, and allocates no memory while contacts are
/// moved (to begin and end a contact, and to change the model, it may allocate).
///
/// The model may be replaced at any time. Contacts stay in place (ContactSimulation::takeOver); the
/// loop computes with the old model until the new one has the columns that the contacts need.
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
  /// Waits for the running step and block of columns.
  ~TouchLoop();
  TouchLoop(const TouchLoop&) = delete;
  TouchLoop& operator=(const TouchLoop&) = delete;

  /// Sets the model that is touched as soon as it is prepared; returns its number in snapshots. A
  /// model with the same operators (equal key()) as the one before keeps the columns. Null: no
  /// model; the contacts begun until now end, even if another model follows at once, the loop
  /// sleeps, and the columns are kept for the next model.
  std::uint64_t setModel(std::shared_ptr<const TouchModel> model);

  /// Begins a contact at the place nearest to `at` (mm, unloaded shape). For `value` see
  /// bem::ContactSimulation::begin(). Without a model it begins as soon as there is one. Throws
  /// TouchRefused: numbers that are not finite or out of range, more contacts than a snapshot
  /// holds.
  TouchId begin(const bem::ContactTool& tool, const Eigen::Vector3d& at,
                const Eigen::Vector3d& value) {
    return input_.begin(tool, at, value);
  }
  /// Moves a contact; ignores values that are not finite, and contacts that have ended.
  void set(TouchId id, const Eigen::Vector3d& value) { input_.set(id, value); }
  /// Ends a contact. A contact that is never ended stays as a pin.
  void end(TouchId id) {
    input_.end(id);
    // Without a model the loop sleeps, but the contact's slot is needed for others.
    LoopMailbox::signal(mailbox_.loopSignal);
  }

  /// Announces where the next touch may begin (mm): columns around it are computed.
  void expect(const Eigen::Vector3d& point);

  /// Time from set() to the publication of the snapshot with the force, of all values that were
  /// used.
  Latency latency() const { return latencies_.all.read(); }
  /// The parts of latency(), in their order, and the delays of wake-ups.
  struct Latencies {
    Latency all;
    Latency untilTaken;  ///< from set() until the loop takes the value
    Latency step;        ///< until the forces are found, of those steps that had news
    Latency publishing;  ///< until the snapshot is published
    Latency lateness;    ///< of every wake-up, behind the requested time
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
  /// The model with the number of a snapshot; null if it is not touched any more.
  std::shared_ptr<const TouchableModel> model(std::uint64_t number) const {
    return worker_.model(number);
  }

  /// Records all input from now on, up to `limit` commands. Reserves addresses for them (120 bytes
  /// each), which the system backs with memory on first use, so the loop never allocates. Contacts
  /// that exist already begin at step 0. Discards a recording that is running.
  void startRecording(std::size_t limit = 1U << 19U);
  /// Ends the recording and returns it; empty if none was running.
  TouchRecording stopRecording();

 private:
  bool runGuarded(const std::stop_token& stop);
  void run(const std::stop_token& stop);
  void waitUntil(Clock::time_point due, Clock::time_point earliest);
  void receiveModel();
  void swapIfReady();
  void retire(ReadyModel* model);
  void takeInput();
  void takeRecorder();
  void apply(const TouchCommand& command);
  void record(const TouchCommand& command);
  void askForColumns();
  void publish();

  LoopMailbox mailbox_;
  TouchInput input_;
  mutable std::mutex readers_;  // among readers
  mutable TripleBuffer<TouchSnapshot> results_;

  struct Histograms {
    LatencyHistogram all, untilTaken, step, publishing, lateness;
  };
  Histograms latencies_;

  std::mutex recorderMutex_;  // guards isRecording_
  bool isRecording_ = false;
  std::atomic<TouchRecording*> newRecording_{nullptr}, finished_{nullptr};
  std::atomic<bool> stopsRecording_{false};

  std::mutex hoverMutex_;  // between expect() and the worker
  Eigen::Vector3d hover_ = Eigen::Vector3d::Zero();
  bool hasHover_ = false;
  TouchSnapshot focusSnapshot_;  // of the worker's thread

  // Only the loop's thread uses them.
  ReadyModel* touched_ = nullptr;
  ReadyModel* next_ = nullptr;
  int nextReady_ = -1, stepsSinceCheck_ = 0;
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
