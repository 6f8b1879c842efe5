#pragma once

#include <array>
#include <atomic>

namespace palpa::app {

/// Transfers the newest value from one thread to another; neither side locks or waits. A newer
/// value replaces one that was not fetched. One writer and one reader at a time.
template <class T>
class TripleBuffer {
 public:
  // The writer's side.
  /// The value that publish() hands over; contains some older value before.
  T& back() { return values_[back_]; }
  void publish() { back_ = middle_.exchange(back_ | kNew, std::memory_order_acq_rel) & kIndex; }

  // The reader's side.
  bool hasNew() const { return (middle_.load(std::memory_order_relaxed) & kNew) != 0; }
  /// Fetches the newest value into front(); false if there is none since the last call.
  bool update() {
    if (!hasNew()) return false;
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    return true;
  }
  const T& front() const { return values_[front_]; }

 private:
  static constexpr unsigned kIndex = 3, kNew = 4;
  std::array<T, 3> values_{};
  unsigned back_ = 0;
  std::atomic<unsigned> middle_ = 1;
  unsigned front_ = 2;
};

}  // namespace palpa::app
