#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "app/core/model/touch_model.h"

namespace palpa::app {

/// One phase of the present or the last build; the phases are those of buildTouchModel().
struct BuildStage {
  std::string phase;
  double seconds = 0;   ///< so far
  double fraction = 0;  ///< 0 … 1
};

/// Where the rebuild stands; a copy, consistent in itself.
struct RebuildStatus {
  enum class State {
    kEmpty,  ///< nothing was submitted yet
    /// The newest revision is being built (or waits for the worker to let go). When it is
    /// modelRevision already, model() is an update of an earlier one, and its own is being built.
    kBuilding,
    kUpToDate,   ///< model() belongs to the newest revision
    kFailed,     ///< the newest revision cannot be built; `error` says why
    kCancelled,  ///< the person stopped the newest revision
  };
  State state = State::kEmpty;
  std::uint64_t revision = 0;       ///< newest revision submitted; 0: none
  std::uint64_t modelRevision = 0;  ///< revision of model(); 0: none
  std::string phase;                ///< that runs, as in buildTouchModel(); empty unless kBuilding
  double fraction = 0;              ///< of the phase, 0 … 1
  double progress = 0;              ///< over all phases, 0 … 1, never falling during a build
  std::vector<BuildStage> stages;   ///< that were begun, in their order
  std::string error;                ///< for people; empty unless kFailed
  /// Of the last geometry check that was finished: why it failed, or warnings. Never null.
  GeometryError::Findings findings = std::make_shared<std::vector<modeling::GeometryFinding>>();
  /// Of model() when it is an update (BuildReport::residual): how exactly it is solved.
  std::optional<double> residual;
  /// Condition number of the equations of model(), estimated when nothing else is to be done; 0
  /// before.
  double condition = 0;
  /// Estimated relative error of the force under a fingertip on model() (estimateTouchError()),
  /// found like the condition number; 0 before.
  double touchError = 0;
};

/// Turns edits into models on a thread of its own: a snapshot of the project goes in, an immutable
/// TouchModel comes out. A newer snapshot cancels the build of an older one; what an older build
/// still delivers is dropped. After an error or a cancelled build the last good model stays.
///
/// When control points have moved, and little else, an update of the last complete model comes
/// first (updateTouchModel()), unless building takes no time, and the complete one after it.
///
/// All functions may be called from any thread. `changed` is called after every change of
/// status() or model(), from the worker or from the caller of submit() or cancel(), without locks
/// held; it must not block and not call back into submit() or the destructor.
class RebuildPipeline {
 public:
  explicit RebuildPipeline(BuildOptions options = {}, int threads = 0,
                           std::function<void()> changed = {});
  /// Cancels what is being built and waits for the worker (some 20 ms of work).
  ~RebuildPipeline();
  RebuildPipeline(const RebuildPipeline&) = delete;
  RebuildPipeline& operator=(const RebuildPipeline&) = delete;

  /// Starts to build the snapshot, once no newer one has come for the time `quiet`, and returns its
  /// revision (1, 2, …). What is being built for an older one stops at once.
  std::uint64_t submit(modeling::Project snapshot, std::chrono::milliseconds quiet = {});

  /// Starts to build what submit() still holds back.
  void startPending();

  /// Stops the present build. Nothing happens when none runs.
  void cancel();

  /// Stores the model of the newest revision in BuildOptions::cache, as soon as it is there and
  /// nothing else is to be done. A newer revision takes this back.
  void keepModel();

  /// The newest finished model; null before the first.
  std::shared_ptr<const TouchModel> model() const;
  RebuildStatus status() const;

  /// Waits until nothing is being built (nor stored); false when the time is over before.
  bool waitUntilSettled(std::chrono::milliseconds most) const;

 private:
  enum class Task { kBuild, kEstimate, kKeep };

  void work(const std::stop_token& stop);
  /// What is to be done next; called with the lock held.
  std::optional<Task> nextTask() const;
  /// Returns when there is a task or `stop` was asked for; nothing then.
  std::optional<Task> waitForTask(std::unique_lock<std::mutex>& lock, const std::stop_token& stop);
  void advance(std::uint64_t revision, std::string_view phase, double fraction);
  void closeStage();
  void estimate(const TouchModel& model, const Job& job);
  void build(std::uint64_t revision, const modeling::Project& project, const Job& job);
  /// Offers an update of the last complete model when there is one.
  void update(std::uint64_t revision, const modeling::Project& project, const Job& job);
  void take(std::uint64_t revision, std::shared_ptr<const TouchModel>& model);
  void finish(std::uint64_t revision, RebuildStatus::State state, std::string error,
              std::shared_ptr<const TouchModel> model, GeometryError::Findings findings = nullptr);
  void notify() const;

  const BuildOptions options_;
  const int threads_;
  const std::function<void()> changed_;

  mutable std::mutex mutex_;  // guards everything below
  mutable std::condition_variable_any wake_;
  mutable std::condition_variable settled_;
  RebuildStatus status_;
  std::optional<modeling::Project> waiting_;  // the newest snapshot, until the worker takes it
  std::chrono::steady_clock::time_point notBefore_;  // the worker takes it
  std::stop_source current_;                         // stops the build of the snapshot taken last
  std::shared_ptr<const TouchModel> model_;
  std::chrono::steady_clock::time_point stageBegan_;
  bool estimateDue_ = false;
  bool keepDue_ = false;
  bool isKeeping_ = false;

  // The last complete model, and what it was built from; the worker's own.
  modeling::Project formerProject_;
  std::shared_ptr<const TouchModel> former_;

  std::jthread worker_;  // last: it uses all of the above
};

}  // namespace palpa::app
