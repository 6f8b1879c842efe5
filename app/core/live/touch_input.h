#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <chrono>
#include <cstdint>
#include <span>

#include "app/core/live/touch_snapshot.h"
#include "app/core/live/triple_buffer.h"
#include "base/error.h"

namespace palpa::app {

/// Thrown if a touch cannot begin; the message is for users.
class TouchRefused : public Error {
 public:
  using Error::Error;
};

/// Transfers commands from any number of threads to the thread of the loop, without locks: one slot
/// per contact, in which the newest value wins.
class TouchInput {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr int kSlots = TouchSnapshot::kMaxContacts;

  // For any thread; a contact belongs to the thread that began it. See TouchLoop.
  TouchId begin(const bem::ContactTool& tool, const Eigen::Vector3d& at,
                const Eigen::Vector3d& value);
  void set(TouchId id, const Eigen::Vector3d& value);
  void end(TouchId id);

  // For the loop's thread.
  /// True if take() has commands to pass on.
  bool hasNews() const;
  /// Number of contacts begun until now. From any thread.
  std::uint64_t count() const { return count_.load(std::memory_order_acquire); }
  /// The contacts that have begun and not ended: one bit per slot.
  std::uint64_t begun() const { return begun_.load(std::memory_order_acquire); }
  /// Calls `apply` with the new TouchCommands of these contacts.
  template <class Apply>
  void take(std::uint64_t begun, const Apply& apply) {
    for (; begun != 0; begun &= begun - 1) takeSlot(std::countr_zero(begun), apply);
  }
  /// Ends the contacts among the first `count` that were begun. Contacts begun later that were
  /// passed on already end too, but are passed on again.
  template <class Apply>
  void endAll(std::uint64_t count, const Apply& apply) {
    for (std::uint64_t left = begun(); left != 0; left &= left - 1) {
      const int k = std::countr_zero(left);
      Slot& slot = slots_[k];
      if (slot.isTouching) apply(endOf(slot));
      if (slot.order <= count) {
        slot.open.store(0);
        free(k);
      } else if (slot.isTouching) {
        slot.begin.value = slot.value;
        slot.isTouching = false;
      }
    }
  }
  /// Without a model: frees the slots of contacts that have ended.
  void dropEnded();
  /// Calls `apply` with commands that begin the present contacts with their present values.
  template <class Apply>
  void repeat(const Apply& apply) const {
    for (const Slot& slot : slots_) {
      if (!slot.isTouching) continue;
      TouchCommand command = slot.begin;
      command.value = slot.value;
      apply(command);
    }
  }
  /// Times of the set() calls whose values take() has passed on since clearSaid().
  std::span<const Clock::time_point> said() const {
    return std::span(said_).first(static_cast<std::size_t>(saidCount_));
  }
  void clearSaid() { saidCount_ = 0; }

 private:
  struct Value {
    TouchId id = 0;
    Eigen::Vector3d value = Eigen::Vector3d::Zero();
    Clock::time_point said;
  };
  /// One contact. The thread that sets its bit in used_ fills it in; its bit in begun_ hands it to
  /// the loop.
  struct Slot {
    std::atomic<TouchId> open{0};  // 0 after its end
    std::atomic<int> setters{0};   // number of threads in set()
    TouchId generation = 0;
    std::uint64_t order = 0;  // number among all contacts begun
    TouchCommand begin;
    TripleBuffer<Value> values;
    std::atomic<TouchId> ending{0};  // the id of the ended contact
    // Only the loop's thread uses them.
    bool isTouching = false;
    Eigen::Vector3d value = Eigen::Vector3d::Zero();
  };
  static_assert(kSlots == 64, "one bit each");

  static TouchCommand endOf(const Slot& slot) {
    return {TouchCommand::Kind::kEnd,
            slot.begin.id,
            {},
            Eigen::Vector3d::Zero(),
            Eigen::Vector3d::Zero()};
  }
  template <class Apply>
  void takeSlot(int index, const Apply& apply) {
    Slot& slot = slots_[index];
    const bool isEnding = slot.ending.load(std::memory_order_acquire) == slot.begin.id;
    if (!slot.isTouching) {
      slot.value = slot.begin.value;
      slot.isTouching = true;
      apply(slot.begin);
    }
    const TouchId id = slot.begin.id;
    if (slot.values.update() && slot.values.front().id == id) {
      const Value& newest = slot.values.front();
      said_[saidCount_++] = newest.said;
      if (newest.value != slot.value) {
        slot.value = newest.value;
        apply({TouchCommand::Kind::kSet, id, {}, Eigen::Vector3d::Zero(), newest.value});
      }
    }
    if (isEnding) {
      apply(endOf(slot));
      free(index);
    }
  }
  void free(int index);

  std::array<Slot, kSlots> slots_;
  std::atomic<std::uint64_t> used_{0}, begun_{0};
  std::atomic<std::uint64_t> count_{0};
  std::atomic<int> balls_{0};
  // Only the loop's thread uses them.
  std::array<Clock::time_point, kSlots> said_;
  int saidCount_ = 0;
};

}  // namespace palpa::app
