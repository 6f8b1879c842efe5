#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "app/core/live/loop_mailbox.h"

namespace palpa::app {

/// Two threads that work for a touch loop. One prepares models, computes the columns that contacts
/// wait for, and releases models that are not used any more. The other, of low priority, computes
/// the remaining columns while the first is idle, columns around the focus first.
///
/// In large models, the block of columns that a new place needs takes seconds. There the first
/// thread solves for the place alone, for which the other one stops, roughly where that is quicker,
/// and leaves the better solution and the columns around the place to the other one. Contacts with
/// several masks (balls) get rough columns instead, which the other one replaces.
class TouchWorker {
 public:
  struct Options {
    int threads = 0;          ///< for columns; 0: all cores
    double columnsLimit = 0;  ///< bytes that columns may take; 0: what is available
    bool computesAll = true;  ///< false: only columns that contacts wait for
    /// Models with as many unknowns answer new places alone first.
    Eigen::Index answersPlacesFrom = 9000;
  };
  /// `focus` adds the points where columns are needed next to a list. It is called on the thread of
  /// low priority.
  TouchWorker(LoopMailbox& mailbox, Options options,
              std::function<void(std::vector<Eigen::Vector3d>&)> focus);
  /// Waits for the block of columns that is being computed.
  ~TouchWorker();

  /// From any thread. Null: no model, and the first `begun` contacts end. Returns the model's
  /// number: 1, 2, …
  std::uint64_t setModel(std::shared_ptr<const TouchModel> model, std::uint64_t begun);

  struct Status {
    std::uint64_t newest = 0;    ///< number of the model set last; 0: none
    std::uint64_t prepared = 0;  ///< number of the model handed to the loop last
    double columnsReady = 0;     ///< of that model, 0 … 1
    std::string error;           ///< for users; empty without an error
  };
  Status status() const;
  /// Null if the model is not used any more.
  std::shared_ptr<const TouchableModel> model(std::uint64_t number) const;

 private:
  void work(const std::stop_token& stop);
  void fill(const std::stop_token& stop);
  /// Calls `some` until it returns false (nothing to do), then waits for the signal, repeatedly.
  template <class Some>
  void repeat(const std::stop_token& stop, std::atomic<std::uint32_t>& signal, const Some& some);
  void releaseRetired();
  bool prepare();
  bool answersPlaces(const TouchableModel& model) const;
  bool isFilled(std::uint64_t number) const;
  enum class Answer { kNone, kKnown, kComputed };
  Answer answerPlace(const std::shared_ptr<const TouchableModel>& model,
                     const ColumnRequest& request, const std::stop_token& stop);
  bool computeRequested(const ColumnRequest& request, const std::stop_token& stop);
  bool computeOthers(const std::stop_token& stop);
  bool improvePlace(const std::stop_token& stop);
  void computeRough(const TouchableModel& model, std::span<const int> nodes,
                    const std::stop_token& stop);
  void stopFiller();
  void compute(const TouchableModel& model, std::span<const int> nodes,
               const std::stop_token& stop);
  bool hasMemoryFor(const TouchableModel& model, bool isUrgent) const;
  void setError(std::string error);

  struct PendingModel {
    std::uint64_t number = 0;
    std::shared_ptr<const TouchModel> model;
    std::uint64_t ended = 0;  // as in ReadyModel
  };
  struct Numbered {
    std::uint64_t number = 0;
    std::shared_ptr<const TouchableModel> model;
  };

  /// A place with a rough response.
  struct RoughPlace {
    std::weak_ptr<const TouchableModel> model;
    bem::SurfacePoint point;
    double radius = 0;  ///< mm, of the mask
  };

  LoopMailbox& mailbox_;
  const Options options_;
  const std::function<void(std::vector<Eigen::Vector3d>&)> focus_;

  mutable std::mutex mutex_;  // guards what follows, up to columns_
  Status status_;
  std::optional<PendingModel> pending_;
  std::vector<Numbered> models_;  // handed to the loop and not retired yet
  std::vector<RoughPlace> rough_;

  // Only the worker uses them.
  ModelCache::Key columnsKey_;
  std::shared_ptr<bem::GreensColumns> columns_;  // of the newest model, for the next one

  /// Locked by the thread that computes a block. Not redundant beside the lock of GreensColumns,
  /// which is one per model: requests may belong to the touched model while the filler works for
  /// the next one, and two blocks at once would share the cores and need twice the memory of
  /// hasMemoryFor().
  std::mutex computing_;
  std::atomic<bool> isUrgent_{false};  // contacts wait for columns: the filler pauses
  std::stop_source fillerBlock_;       // stops the filler's present block; guarded by mutex_
  std::atomic<std::uint32_t> fillSignal_{0};

  std::jthread worker_, filler_;  // last: they use all of the above
};

}  // namespace palpa::app
