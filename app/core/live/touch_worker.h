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

#include "app/core/live/touch_stepper.h"
#include "app/core/live/triple_buffer.h"

namespace palpa::app {

/// What the loop and the worker hand each other, without locks.
struct LoopMailbox {
  /// A body ready to be touched; without a player: there is nothing to touch any more.
  struct ReadyModel {
    std::uint64_t number = 0;
    std::unique_ptr<TouchStepper> player;
    /// Before it there was nothing to touch: so many contacts, counted from the first, have ended.
    std::uint64_t ended = 0;
    ReadyModel* next = nullptr;
  };
  /// Nodes of one body whose columns the contacts wait for.
  struct ColumnRequest {
    static constexpr int kMaxNodes = 1024;
    std::uint64_t number = 0;
    int count = 0;
    std::array<int, kMaxNodes> nodes{};
  };
  struct ColumnRequests {
    ColumnRequest touched, next;
  };

  std::atomic<ReadyModel*> offered{nullptr};  // to the loop; the newest replaces others
  std::atomic<ReadyModel*> retired{nullptr};  // to the worker; a list
  TripleBuffer<ColumnRequests> wanted;        // to the worker
  std::atomic<std::uint32_t> loopSignal{0};   // changes when there is something to do
  std::atomic<std::uint32_t> workerSignal{0};

  static void signal(std::atomic<std::uint32_t>& what) {
    what.fetch_add(1, std::memory_order_release);
    what.notify_all();
  }
};

/// What a touch loop needs done beside it. One thread prepares bodies, computes the columns that
/// contacts wait for, and releases what is not used any more; another, of low priority, computes
/// the other columns when there is time, those around the focus first.
class TouchWorker {
 public:
  struct Options {
    int threads = 0;          ///< for columns; 0: all cores
    double columnsLimit = 0;  ///< bytes that columns may take; 0: what is available
    bool computesAll = true;  ///< false: only columns that contacts wait for
  };
  /// `focus` tells where columns are needed next: it adds points to a list; called on the thread of
  /// low priority.
  TouchWorker(LoopMailbox& mail, Options options,
              std::function<void(std::vector<Eigen::Vector3d>&)> focus);
  /// Waits for the block of columns at hand.
  ~TouchWorker();

  /// From any thread. Null: nothing to touch, and the first `begun` contacts end. Returns its
  /// number: 1, 2, …
  std::uint64_t setModel(std::shared_ptr<const TouchModel> model, std::uint64_t begun);

  struct Status {
    std::uint64_t newest = 0;    ///< number of the model set last; 0: none
    std::uint64_t prepared = 0;  ///< number of the one offered to the loop last
    double columnsReady = 0;     ///< of that one, 0 … 1
    std::string error;           ///< for people; empty when all is well
  };
  Status status() const;
  /// Null when it is not used any more.
  std::shared_ptr<const TouchableModel> body(std::uint64_t number) const;

 private:
  void work(const std::stop_token& stop);
  void fill(const std::stop_token& stop);
  /// Does `some` until it says that there is nothing to do, and then waits for the signal.
  template <class Some>
  void repeat(const std::stop_token& stop, std::atomic<std::uint32_t>& signal, const Some& some);
  void releaseRetired();
  bool prepare();
  bool computeRequested(const LoopMailbox::ColumnRequest& wanted, const std::stop_token& stop);
  bool computeOthers(const std::stop_token& stop);
  void compute(const TouchableModel& body, std::span<const int> nodes, const std::stop_token& stop);
  bool hasMemoryFor(const TouchableModel& body, bool isUrgent) const;
  void setError(std::string error);

  struct Request {
    std::uint64_t number = 0;
    std::shared_ptr<const TouchModel> model;
    std::uint64_t ended = 0;  // as in ReadyModel
  };
  struct Numbered {
    std::uint64_t number = 0;
    std::shared_ptr<const TouchableModel> body;
  };

  LoopMailbox& mail_;
  const Options options_;
  const std::function<void(std::vector<Eigen::Vector3d>&)> focus_;

  mutable std::mutex mutex_;  // guards what follows, up to columns_
  Status status_;
  std::optional<Request> request_;
  std::vector<Numbered> bodies_;  // that are offered or touched

  // Of the worker alone.
  ModelCache::Key columnsKey_;
  std::shared_ptr<bem::GreensColumns> columns_;  // of the newest body, kept for the next

  std::mutex computing_;               // one at a time computes columns
  std::atomic<bool> isUrgent_{false};  // contacts wait: the others have time
  std::atomic<std::uint32_t> fillSignal_{0};

  std::jthread worker_, filler_;  // last: they use all of the above
};

}  // namespace palpa::app
