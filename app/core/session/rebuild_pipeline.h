#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "app/core/model/build_phase.h"
#include "app/core/model/build_touch_model.h"
#include "app/core/results/accuracy_advice.h"
#include "app/core/setup/support_conflict.h"
#include "base/job.h"
#include "base/worker_thread.h"

namespace palpa::app {

/// One phase of the present or the last build; the phases are listed in kBuildPhases.
struct BuildStage {
  Phase phase{};
  double seconds = 0;   ///< so far
  double fraction = 0;  ///< 0 … 1
};

/// Cause of a failed build, if front ends can offer a remedy for it.
struct FailureReason {
  std::optional<SupportConflict> conflict{};  ///< two supports contradict each other
  std::string emptyRegion{};  ///< MeshRegion::name of a region without any surface; empty: none
  bool isFree = false;        ///< the supports leave the body free to move
  bool needsDensity = false;  ///< gravity acts, but the material has no density
  /// A mesh with which the body can be built (suggestMesh()), if the present one is too large or
  /// does not bound a body; found some seconds after the failure.
  std::optional<modeling::MeshSettings> mesh{};
};

/// State of the rebuild; a consistent copy.
struct RebuildStatus {
  enum class State {
    kEmpty,  ///< nothing was submitted yet
    /// The newest revision is being built, or waits for its turn. If modelRevision is this revision
    /// already, model() is an incremental update and the full rebuild is running.
    kBuilding,
    kUpToDate,   ///< model() belongs to the newest revision
    kFailed,     ///< the newest revision cannot be built; `error` is the reason
    kCancelled,  ///< the user stopped the newest revision
  };
  State state = State::kEmpty;
  std::uint64_t revision = 0;       ///< newest revision submitted; 0: none
  std::uint64_t modelRevision = 0;  ///< revision of model(); 0: none
  std::optional<Phase> phase;       ///< that runs; none unless kBuilding
  double fraction = 0;              ///< of the phase, 0 … 1
  double progress = 0;              ///< over all phases, 0 … 1, never falling during a build
  std::vector<BuildStage> stages;   ///< the phases begun so far, in their order
  std::string error;                ///< for users; empty unless kFailed
  /// Findings of the last completed geometry check: the reason of the failure, or warnings. Never
  /// null.
  GeometryError::Findings findings = std::make_shared<std::vector<modeling::GeometryFinding>>();
  FailureReason reason;  ///< empty unless kFailed
  /// BuildReport::residual of model() if it is an incremental update.
  std::optional<double> residual;
  /// Estimated condition number of the equations of model(); 0 until it is known. It is estimated
  /// when nothing else is to be done.
  double condition = 0;
  /// Estimated relative error of the force under a fingertip on model() (estimateTouchError()); 0
  /// until it is known.
  double touchError = 0;
  /// Requested and reached accuracy of model(); null until it is known.
  std::shared_ptr<const AccuracyAdvice> accuracy;
};

/// Builds models in the background: a snapshot of the project goes in, an immutable TouchModel
/// comes out. A newer snapshot cancels the build of an older one, whose results are dropped. After
/// an error or a cancelled build the last good model stays.
///
/// If control points have moved, and little else changed, an incremental update of the last
/// complete model (updateTouchModel()) precedes the full rebuild, unless a full rebuild takes no
/// time.
///
/// All functions may be called from any thread. `changed` is called after every change of status()
/// or model(), from the worker or from the caller of submit() or cancel(), without locks held; it
/// must not block and must not call submit() or the destructor.
class RebuildPipeline {
 public:
  /// `threads`: for a build; 0: all cores.
  explicit RebuildPipeline(BuildOptions options = {}, int threads = 0,
                           std::function<void()> changed = {});
  /// Cancels the present build and waits for the worker (about 20 ms).
  ~RebuildPipeline() = default;
  RebuildPipeline(const RebuildPipeline&) = delete;
  RebuildPipeline& operator=(const RebuildPipeline&) = delete;

  /// Builds the snapshot after the time `quiet`, unless a newer one replaces it before. Returns its
  /// revision (1, 2, …). The build of an older revision stops at once.
  std::uint64_t submit(modeling::Project snapshot, std::chrono::milliseconds quiet = {});

  /// Ends the `quiet` time of submit().
  void startPending();

  /// Stops the present build; does nothing if none runs.
  void cancel();

  /// Stores the model of the newest revision in BuildOptions::cache as soon as it is complete. A
  /// newer revision revokes this.
  void keepModel();

  /// The newest finished model; null before the first.
  std::shared_ptr<const TouchModel> model() const;
  RebuildStatus status() const;

  /// Waits until nothing is being built or stored; false after the time `limit`.
  bool waitUntilSettled(std::chrono::milliseconds limit) const;

 private:
  // Tasks of the worker.
  void build(std::uint64_t revision, const modeling::Project& project, const std::stop_token& stop);
  void keep(const std::stop_token& stop);
  void suggest(std::uint64_t revision, const modeling::Project& project,
               const std::stop_token& stop);
  void estimate(const std::stop_token& stop);

  /// False if `stop` was triggered before the quiet time was over.
  bool waitUntilDue(const std::stop_token& stop);
  void offerUpdate(std::uint64_t revision, const modeling::Project& project, const Job& job);
  template <class Value>
  void setEstimate(const TouchModel& model, Value RebuildStatus::*estimate, Value value);
  void estimateAccuracy(const TouchModel& model, const Job& job);
  void postKeep();
  void advance(std::uint64_t revision, Phase phase, double fraction);
  void closeStage();
  bool isCurrent(std::uint64_t revision) const;
  void take(std::uint64_t revision, std::shared_ptr<const TouchModel>& model);
  void finish(std::uint64_t revision, RebuildStatus::State state, std::string error,
              std::shared_ptr<const TouchModel> model, GeometryError::Findings findings = nullptr,
              FailureReason reason = {});
  void notify() const;

  const BuildOptions options_;
  const int threads_;
  const std::function<void()> changed_;

  mutable std::mutex mutex_;  // guards everything down to isKeeping_
  std::condition_variable_any due_;
  mutable std::condition_variable settled_;
  RebuildStatus status_;
  std::chrono::steady_clock::time_point notBefore_;  // start of the build submitted last
  std::shared_ptr<const TouchModel> model_;
  std::chrono::steady_clock::time_point stageBegan_;
  BuildProgress progress_;
  bool isKeepDue_ = false, isKeeping_ = false;

  // The last complete model and its project; only the worker uses them.
  modeling::Project formerProject_;
  std::shared_ptr<const TouchModel> former_;
  // The last estimated model and its project; only the worker uses them.
  modeling::Project sampledProject_;
  std::optional<AccuracySample> sample_;

  WorkerThread worker_;  // last: it uses all of the above
};

}  // namespace palpa::app
