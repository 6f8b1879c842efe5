#include "app/core/live/touch_input.h"

#include <thread>

namespace palpa::app {
namespace {

using Eigen::Vector3d;

constexpr double kMaxRadius = 1e6;  // mm
constexpr double kMaxFriction = 10;

std::uint64_t bit(int place) {
  return std::uint64_t{1} << static_cast<unsigned>(place);
}

bool isBall(const bem::ContactTool& tool) {
  return tool.kind == bem::ContactTool::Kind::kProbe;
}

void check(const bem::ContactTool& tool, const Vector3d& at, const Vector3d& value) {
  if (!at.allFinite() || !value.allFinite())
    throw TouchRefused("the place or the value of a touch is not a finite number");
  if (!(tool.radius > 0 && tool.radius <= kMaxRadius))
    throw TouchRefused("the radius of a touch must be above 0 and at most 1e6 mm");
  if (!(tool.friction >= 0 && tool.friction <= kMaxFriction))
    throw TouchRefused("the friction coefficient of a touch must be 0 to 10");
}

}  // namespace

TouchId TouchInput::begin(const bem::ContactTool& tool, const Vector3d& at, const Vector3d& value) {
  check(tool, at, value);
  if (isBall(tool) && balls_.fetch_add(1) >= TouchSnapshot::kMaxBalls) {
    balls_.fetch_sub(1);
    throw TouchRefused("at most 8 balls can press at once; let go of one first");
  }
  std::uint64_t used = used_.load(std::memory_order_acquire);
  int index = 0;
  do {
    index = std::countr_one(used);
    if (index == kPlaces) {
      if (isBall(tool)) balls_.fetch_sub(1);
      throw TouchRefused("at most 64 touches can be held at once; let go of one first");
    }
  } while (!used_.compare_exchange_weak(used, used | bit(index), std::memory_order_acq_rel));
  Place& place = places_[index];
  // The hand whose contact was taken away may be saying its last value just now.
  while (place.setters.load() != 0) std::this_thread::yield();
  const TouchId id = (++place.generation << 6U) | static_cast<TouchId>(index);
  place.order = count_.fetch_add(1, std::memory_order_acq_rel) + 1;
  place.begin = {TouchCommand::Kind::kBegin, id, tool, at, value};
  place.open.store(id, std::memory_order_release);
  begun_.fetch_or(bit(index), std::memory_order_release);
  return id;
}

void TouchInput::set(TouchId id, const Vector3d& value) {
  Place& place = places_[id % kPlaces];
  if (place.open.load(std::memory_order_acquire) != id || !value.allFinite()) return;
  // Whoever takes the contact away closes it first: either it is seen to be closed here, or the
  // place's next owner sees that it is being set. Both in the one order of all such operations.
  place.setters.fetch_add(1);
  if (place.open.load() == id) {
    place.values.back() = {id, value, Clock::now()};
    place.values.publish();
  }
  place.setters.fetch_sub(1, std::memory_order_release);
}

void TouchInput::end(TouchId id) {
  Place& place = places_[id % kPlaces];
  TouchId expected = id;
  if (place.open.compare_exchange_strong(expected, 0))
    place.ending.store(id, std::memory_order_release);
}

bool TouchInput::hasNews() const {
  for (std::uint64_t left = begun(); left != 0; left &= left - 1) {
    const Place& place = places_[std::countr_zero(left)];
    if (!place.isTouching || place.values.hasNew() ||
        place.ending.load(std::memory_order_relaxed) == place.begin.id)
      return true;
  }
  return false;
}

void TouchInput::dropEnded() {
  for (std::uint64_t left = begun(); left != 0; left &= left - 1) {
    const int index = std::countr_zero(left);
    const Place& place = places_[index];
    if (place.ending.load(std::memory_order_acquire) == place.begin.id) free(index);
  }
}

void TouchInput::free(int index) {
  Place& place = places_[index];
  place.isTouching = false;
  if (isBall(place.begin.tool)) balls_.fetch_sub(1);
  begun_.fetch_and(~bit(index), std::memory_order_relaxed);
  used_.fetch_and(~bit(index), std::memory_order_release);
}

}  // namespace palpa::app
