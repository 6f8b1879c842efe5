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

/// A touch that cannot begin; the message is for people.
class TouchRefused : public Error {
 public:
  using Error::Error;
};

/// The way from those who touch, on any number of threads, to the one thread of the loop, without
/// locks: a place per contact in which the newest value wins.
class TouchInput {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr int kPlaces = TouchSnapshot::kMaxContacts;

  // Of any thread; a contact belongs to the thread that began it. See TouchLoop.
  TouchId begin(const bem::ContactTool& tool, const Eigen::Vector3d& at,
                const Eigen::Vector3d& value);
  void set(TouchId id, const Eigen::Vector3d& value);
  void end(TouchId id);

  // Of the loop's thread.
  /// Is there anything that take() would pass on?
  bool hasNews() const;
  /// How many contacts were begun until now. From any thread.
  std::uint64_t count() const { return count_.load(std::memory_order_acquire); }
  /// The contacts that have begun until now: one bit per place.
  std::uint64_t begun() const { return begun_.load(std::memory_order_acquire); }
  /// Passes on what was said of these contacts, as TouchCommands.
  template <class Apply>
  void take(std::uint64_t begun, const Apply& apply) {
    for (; begun != 0; begun &= begun - 1) takePlace(std::countr_zero(begun), apply);
  }
  /// Ends the contacts among the first `count` that were begun. Of those begun later the ones that
  /// were passed on already end too, but are passed on anew.
  template <class Apply>
  void endAll(std::uint64_t count, const Apply& apply) {
    for (std::uint64_t left = begun(); left != 0; left &= left - 1) {
      const int k = std::countr_zero(left);
      Place& place = places_[k];
      if (place.isTouching) apply(endOf(place));
      if (place.order <= count) {
        place.open.store(0);
        free(k);
      } else if (place.isTouching) {
        place.begin.value = place.value;
        place.isTouching = false;
      }
    }
  }
  /// While there is nothing to touch: frees the places of contacts that have ended again.
  void dropEnded();
  /// The commands with which those contacts would begin as they are now.
  template <class Apply>
  void repeat(const Apply& apply) const {
    for (const Place& place : places_) {
      if (!place.isTouching) continue;
      TouchCommand command = place.begin;
      command.value = place.value;
      apply(command);
    }
  }
  /// When the values were said that take() has passed on since clearSaid().
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
  /// One contact. Whoever set its bit in used_ fills it in; then begun_ hands it to the loop.
  struct Place {
    std::atomic<TouchId> open{0};  // 0 once it was ended
    std::atomic<int> setters{0};   // that are in set()
    TouchId generation = 0;
    std::uint64_t order = 0;  // among all that were begun
    TouchCommand begin;
    TripleBuffer<Value> values;
    std::atomic<TouchId> ending{0};  // the id that was ended
    // Of the loop's thread.
    bool isTouching = false;
    Eigen::Vector3d value = Eigen::Vector3d::Zero();
  };
  static_assert(kPlaces == 64, "one bit each");

  static TouchCommand endOf(const Place& place) {
    return {TouchCommand::Kind::kEnd,
            place.begin.id,
            {},
            Eigen::Vector3d::Zero(),
            Eigen::Vector3d::Zero()};
  }
  template <class Apply>
  void takePlace(int index, const Apply& apply) {
    Place& place = places_[index];
    const bool isEnding = place.ending.load(std::memory_order_acquire) == place.begin.id;
    if (!place.isTouching) {
      place.value = place.begin.value;
      place.isTouching = true;
      apply(place.begin);
    }
    const TouchId id = place.begin.id;
    if (place.values.update() && place.values.front().id == id) {
      const Value& newest = place.values.front();
      said_[saidCount_++] = newest.said;
      if (newest.value != place.value) {
        place.value = newest.value;
        apply({TouchCommand::Kind::kSet, id, {}, Eigen::Vector3d::Zero(), newest.value});
      }
    }
    if (isEnding) {
      apply(endOf(place));
      free(index);
    }
  }
  void free(int index);

  std::array<Place, kPlaces> places_;
  std::atomic<std::uint64_t> used_{0}, begun_{0};
  std::atomic<std::uint64_t> count_{0};
  std::atomic<int> balls_{0};
  // Of the loop's thread.
  std::array<Clock::time_point, kPlaces> said_;
  int saidCount_ = 0;
};

}  // namespace palpa::app
