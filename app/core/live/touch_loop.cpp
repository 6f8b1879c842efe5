#include "app/core/live/touch_loop.h"

#include <pthread.h>

#include <ctime>
#include <utility>

#include "app/core/system/priority.h"
#include "base/unexpected.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;

/// The loop checks whether a new model has the columns that the contacts need when columns have
/// been computed, and after this many steps, because contacts move.
constexpr int kStepsBetweenChecks = 16;
constexpr std::chrono::milliseconds kRateWindow{250};
/// Interval of the checks for new input between two steps.
constexpr std::chrono::microseconds kCheckInterval{250};

void sleepUntil(TouchLoop::Clock::time_point time) {
  const auto since = std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch());
  const std::timespec at{static_cast<std::time_t>(since.count() / 1'000'000'000),
                         static_cast<long>(since.count() % 1'000'000'000)};
  // std::this_thread::sleep_until() reads the clock twice more. After an interruption a step comes
  // early.
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, nullptr);
}

void copyRequest(const std::vector<int>& nodes, const bem::ContactSimulation& simulation,
                 std::uint64_t number, ColumnRequest& request) {
  request.number = number;
  const auto waiting = simulation.waiting();
  request.isOfPlace = waiting.has_value();
  if (waiting) request.place = *waiting;
  request.count = static_cast<int>(
      std::min<std::size_t>(nodes.size(), static_cast<std::size_t>(ColumnRequest::kMaxNodes)));
  std::copy_n(nodes.begin(), request.count, request.nodes.begin());
}

}  // namespace

TouchLoop::TouchLoop(Options options)
    : worker_(mailbox_, options,
              [this](std::vector<Vector3d>& points) {
                read(focusSnapshot_);
                for (const auto& contact : focusSnapshot_.touched())
                  points.push_back(contact.point.position);
                const std::lock_guard lock(hoverMutex_);
                if (hasHover_) points.push_back(hover_);
              }),
      thread_([this](const std::stop_token& stop) {
        while (!runGuarded(stop)) {
        }
      }) {}

TouchLoop::~TouchLoop() {
  thread_.request_stop();
  LoopMailbox::signal(mailbox_.loopSignal);
  thread_.join();
  if (next_) retire(next_);
  if (touched_) retire(touched_);
  delete newRecording_.load();
  delete finished_.load();
}

std::uint64_t TouchLoop::setModel(std::shared_ptr<const TouchModel> model) {
  return worker_.setModel(std::move(model), input_.count());
}

void TouchLoop::expect(const Vector3d& point) {
  if (!point.allFinite()) return;
  const std::lock_guard lock(hoverMutex_);
  hover_ = point;
  hasHover_ = true;
}

void TouchLoop::read(TouchSnapshot& into) const {
  const std::lock_guard lock(readers_);
  results_.update();
  into = results_.front();
}

void TouchLoop::startRecording(std::size_t limit) {
  auto recording = std::make_unique<TouchRecording>();
  recording->entries.reserve(limit);
  const std::lock_guard lock(recorderMutex_);
  delete newRecording_.exchange(recording.release());
  isRecording_ = true;
  LoopMailbox::signal(mailbox_.loopSignal);
}

TouchRecording TouchLoop::stopRecording() {
  const std::lock_guard lock(recorderMutex_);
  if (!std::exchange(isRecording_, false)) return {};
  stopsRecording_.store(true, std::memory_order_release);
  LoopMailbox::signal(mailbox_.loopSignal);
  finished_.wait(nullptr);
  const std::unique_ptr<TouchRecording> recording(finished_.exchange(nullptr));
  return std::move(*recording);
}

/// False after an exception: the contacts end with their model, and the loop can continue with the
/// next one.
bool TouchLoop::runGuarded(const std::stop_token& stop) {
  try {
    run(stop);
    return true;
  } catch (...) {
    reportUnexpected();
  }
  if (touched_) retire(std::exchange(touched_, nullptr));
  return false;
}

void TouchLoop::run(const std::stop_token& stop) {
  ::pthread_setname_np(::pthread_self(), kThreadName);
  RealtimeScope realtime;
  auto due = Clock::now();
  rateSince_ = due;
  for (;;) {
    const std::uint32_t seen = mailbox_.loopSignal.load(std::memory_order_acquire);
    if (stop.stop_requested()) return;
    receiveModel();
    if (next_) swapIfReady();
    takeInput();
    if (!touched_) {
      publish();
      mailbox_.loopSignal.wait(seen, std::memory_order_acquire);
      due = Clock::now();
      continue;
    }
    began_ = Clock::now();
    touched_->stepper->step();
    stepped_ = Clock::now();
    ++step_;
    if (recording_) ++recording_->steps;
    askForColumns();
    publish();
    realtime.worked(began_, Clock::now());
    // A late step is not made up for, because the user has moved on. A step that came early for its
    // input starts a new period.
    due = due + kPeriod < began_ ? began_ + kPeriod : std::min(due, began_) + kPeriod;
    waitUntil(due, began_ + kMinPeriod);
  }
}

/// Waits until the next step is due or, from `earliest` on, there is input for it.
void TouchLoop::waitUntil(Clock::time_point due, Clock::time_point earliest) {
  auto next = std::min(earliest, due);
  for (;;) {
    const auto now = Clock::now();
    if (now < next) {
      sleepUntil(next);
      latencies_.lateness.add(Clock::now() - next);
      continue;
    }
    if (next >= due || input_.hasNews()) return;
    next = std::min(next + kCheckInterval, due);
  }
}

void TouchLoop::receiveModel() {
  ReadyModel* ready = mailbox_.ready.exchange(nullptr, std::memory_order_acq_rel);
  if (!ready) return;
  if (next_) retire(next_);
  next_ = nullptr;
  if (!ready->stepper || ready->ended > 0) {
    input_.endAll(ready->ended, [this](const TouchCommand& command) { apply(command); });
    if (touched_ && recording_) ++recording_->modelChanges;
    if (touched_) retire(touched_);
    touched_ = nullptr;
  }
  if (!ready->stepper) {
    retire(ready);
    return;
  }
  next_ = ready;
  nextReady_ = -1;
}

/// The next model takes over as soon as it has the columns that the contacts need.
void TouchLoop::swapIfReady() {
  TouchStepper& stepper = *next_->stepper;
  if (touched_ && !touched_->stepper->simulation().contacts().empty()) {
    const int ready = stepper.model().columns()->readyCount();
    if (ready == nextReady_ && ++stepsSinceCheck_ < kStepsBetweenChecks) return;
    nextReady_ = ready;
    stepsSinceCheck_ = 0;
    stepper.takeOver(*touched_->stepper);
    // If the contacts still wait for columns of the old model, nothing is lost by leaving it.
    if (!stepper.missing().empty() && touched_->stepper->simulation().missed().empty()) {
      const std::vector<int>& missing = stepper.missing();
      copyRequest(missing, stepper.simulation(), next_->number, mailbox_.requested.back().next);
      mailbox_.requested.back().touched.count = 0;
      mailbox_.requested.publish();
      LoopMailbox::signal(mailbox_.workerSignal);
      return;
    }
  }
  if (touched_) {
    retire(touched_);
    if (recording_) ++recording_->modelChanges;
  }
  touched_ = std::exchange(next_, nullptr);
}

void TouchLoop::retire(ReadyModel* model) {
  mailbox_.retire(model);
  LoopMailbox::signal(mailbox_.workerSignal);
}

void TouchLoop::takeInput() {
  // In this order, so that a recording contains all contacts begun after its start.
  const std::uint64_t begun = input_.begun();
  takeRecorder();
  if (touched_)
    input_.take(begun, [this](const TouchCommand& command) { apply(command); });
  else
    input_.dropEnded();
}

void TouchLoop::takeRecorder() {
  if (TouchRecording* begins = newRecording_.exchange(nullptr, std::memory_order_acq_rel)) {
    recording_.reset(begins);
    input_.repeat([this](const TouchCommand& command) { record(command); });
  }
  if (stopsRecording_.exchange(false, std::memory_order_acq_rel)) {
    finished_.store(recording_ ? recording_.release() : new TouchRecording());
    finished_.notify_all();
  }
}

void TouchLoop::apply(const TouchCommand& command) {
  record(command);
  touched_->stepper->apply(command);
}

void TouchLoop::record(const TouchCommand& command) {
  if (!recording_) return;
  if (recording_->entries.size() < recording_->entries.capacity())
    recording_->entries.push_back({recording_->steps, command});
  else
    recording_->isFull = true;
}

/// Tells the worker which columns the step missed.
void TouchLoop::askForColumns() {
  const bem::ContactSimulation& simulation = touched_->stepper->simulation();
  if (simulation.missed().empty()) return;
  copyRequest(simulation.missed(), simulation, touched_->number, mailbox_.requested.back().touched);
  mailbox_.requested.back().next.count = 0;
  mailbox_.requested.publish();
  LoopMailbox::signal(mailbox_.workerSignal);
}

void TouchLoop::publish() {
  TouchSnapshot& snapshot = results_.back();
  if (touched_) {
    touched_->stepper->describe(snapshot);
  } else {
    static_cast<TouchSummary&>(snapshot) = {};
  }
  snapshot.step = step_;
  snapshot.time = Clock::now();
  if (const auto elapsed = snapshot.time - rateSince_; elapsed >= kRateWindow) {
    rate_ = static_cast<double>(step_ - rateStep_) / std::chrono::duration<double>(elapsed).count();
    rateSince_ = snapshot.time;
    rateStep_ = step_;
  }
  snapshot.rate = touched_ ? rate_ : 0;
  const auto time = snapshot.time;
  results_.publish();
  for (const auto said : input_.said()) {
    latencies_.all.add(time - said);
    latencies_.untilTaken.add(began_ - said);
    latencies_.step.add(stepped_ - began_);
    latencies_.publishing.add(time - stepped_);
  }
  input_.clearSaid();
}

}  // namespace palpa::app
