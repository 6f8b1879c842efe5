#include "app/core/live/touch_input.h"

#include <thread>

#include "modeling/project/touch_kind.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;

constexpr double kMaxRadius = 1e6;  // mm

std::uint64_t bit(int slot) {
  return std::uint64_t{1} << static_cast<unsigned>(slot);
}

void check(const bem::ContactTool& tool, const Vector3d& at, const Vector3d& value) {
  if (!at.allFinite() || !value.allFinite())
    throw TouchRefused("the place or the value of a touch is not a finite number");
  if (!(tool.radius > 0 && tool.radius <= kMaxRadius))
    throw TouchRefused("the radius of a touch must be above 0 and at most 1e6 mm");
  if (!(tool.friction >= 0 && tool.friction <= modeling::kMaxFriction))
    throw TouchRefused("the friction coefficient of a touch must be 0 to 10");
}

}  // namespace

TouchId TouchInput::begin(const bem::ContactTool& tool, const Vector3d& at, const Vector3d& value) {
  check(tool, at, value);
  if (tool.hasPatch() && balls_.fetch_add(1) >= TouchSnapshot::kMaxBalls) {
    balls_.fetch_sub(1);
    throw TouchRefused("at most 8 balls can press at once; let go of one first");
  }
  std::uint64_t used = used_.load(std::memory_order_acquire);
  int index = 0;
  do {
    index = std::countr_one(used);
    if (index == kSlots) {
      if (tool.hasPatch()) balls_.fetch_sub(1);
      throw TouchRefused("at most 64 touches can be held at once; let go of one first");
    }
  } while (!used_.compare_exchange_weak(used, used | bit(index), std::memory_order_acq_rel));
  Slot& slot = slots_[index];
  // The thread whose contact was ended by endAll() may be in set() at this moment.
  while (slot.setters.load() != 0) std::this_thread::yield();
  const TouchId id = (++slot.generation << 6U) | static_cast<TouchId>(index);
  slot.order = count_.fetch_add(1, std::memory_order_acq_rel) + 1;
  slot.begin = {TouchCommand::Kind::kBegin, id, tool, at, value};
  slot.open.store(id, std::memory_order_release);
  begun_.fetch_or(bit(index), std::memory_order_release);
  return id;
}

void TouchInput::set(TouchId id, const Vector3d& value) {
  Slot& slot = slots_[id % kSlots];
  if (slot.open.load(std::memory_order_acquire) != id || !value.allFinite()) return;
  // endAll() closes a contact first: either this thread sees it closed, or the next owner of the
  // slot sees this setter. Sequential consistency orders these operations.
  slot.setters.fetch_add(1);
  if (slot.open.load() == id) {
    slot.values.back() = {id, value, Clock::now()};
    slot.values.publish();
  }
  slot.setters.fetch_sub(1, std::memory_order_release);
}

void TouchInput::end(TouchId id) {
  Slot& slot = slots_[id % kSlots];
  TouchId expected = id;
  if (slot.open.compare_exchange_strong(expected, 0))
    slot.ending.store(id, std::memory_order_release);
}

bool TouchInput::hasNews() const {
  for (std::uint64_t left = begun(); left != 0; left &= left - 1) {
    const Slot& slot = slots_[std::countr_zero(left)];
    if (!slot.isTouching || slot.values.hasNew() ||
        slot.ending.load(std::memory_order_relaxed) == slot.begin.id)
      return true;
  }
  return false;
}

void TouchInput::dropEnded() {
  for (std::uint64_t left = begun(); left != 0; left &= left - 1) {
    const int index = std::countr_zero(left);
    const Slot& slot = slots_[index];
    if (slot.ending.load(std::memory_order_acquire) == slot.begin.id) free(index);
  }
}

void TouchInput::free(int index) {
  Slot& slot = slots_[index];
  slot.isTouching = false;
  if (slot.begin.tool.hasPatch()) balls_.fetch_sub(1);
  begun_.fetch_and(~bit(index), std::memory_order_relaxed);
  used_.fetch_and(~bit(index), std::memory_order_release);
}

}  // namespace palpa::app
