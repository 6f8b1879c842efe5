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

#include "app/core/touch_model.h"

namespace palpa::app {

/// Where the rebuild stands; a copy, consistent in itself.
struct RebuildStatus {
  enum class State {
    kEmpty,      ///< nothing was submitted yet
    kBuilding,   ///< the newest revision is being built (or waits for the worker to let go)
    kUpToDate,   ///< model() belongs to the newest revision
    kFailed,     ///< the newest revision cannot be built; `error` says why
    kCancelled,  ///< the person stopped the newest revision
  };
  State state = State::kEmpty;
  std::uint64_t revision = 0;       ///< newest revision submitted; 0: none
  std::uint64_t modelRevision = 0;  ///< revision of model(); 0: none
  std::string phase;                ///< "mesh", "assemble", "factorise", "solve" while building
  double fraction = 0;              ///< of the phase, 0 … 1
  std::string error;                ///< for people; empty unless kFailed
};

/// Turns edits into models on a thread of its own: a snapshot of the project goes in, an immutable
/// TouchModel comes out. A newer snapshot cancels the build of an older one; what an older build
/// still delivers is dropped. After an error or a cancelled build the last good model stays.
///
/// All functions may be called from any thread. `changed` is called after every change of
/// status() or model(), from the worker or from the caller of submit() or cancel(), without locks
/// held; it must not block and not call back into submit() or the destructor.
class RebuildPipeline {
 public:
  explicit RebuildPipeline(BuildOptions options = {}, int threads = 0,
                           std::function<void()> changed = {});
  /// Cancels what is being built and waits for the worker (at most about 20 ms of work).
  ~RebuildPipeline();
  RebuildPipeline(const RebuildPipeline&) = delete;
  RebuildPipeline& operator=(const RebuildPipeline&) = delete;

  /// Starts to build the snapshot and returns its revision (1, 2, …).
  std::uint64_t submit(modeling::Project snapshot);

  /// Stops the present build. Nothing happens when none runs.
  void cancel();

  /// The newest finished model; null before the first.
  std::shared_ptr<const TouchModel> model() const;
  RebuildStatus status() const;

  /// Waits until nothing is being built; false when the time is over before.
  bool waitUntilSettled(std::chrono::milliseconds most) const;

 private:
  void work(const std::stop_token& stop);
  void build(std::uint64_t revision, const modeling::Project& project, const bem::Job& job);
  void finish(std::uint64_t revision, RebuildStatus::State state, std::string error,
              std::shared_ptr<const TouchModel> model);
  void notify() const;

  const BuildOptions options_;
  const int threads_;
  const std::function<void()> changed_;

  mutable std::mutex mutex_;  // guards everything below
  mutable std::condition_variable_any wake_;
  mutable std::condition_variable settled_;
  RebuildStatus status_;
  std::optional<modeling::Project> waiting_;  // the newest snapshot, until the worker takes it
  std::stop_source current_;                  // stops the build of the snapshot taken last
  std::shared_ptr<const TouchModel> model_;

  std::jthread worker_;  // last: it uses all of the above
};

}  // namespace palpa::app
