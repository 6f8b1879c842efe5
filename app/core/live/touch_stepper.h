#pragma once

#include <memory>
#include <vector>

#include "app/core/live/touch_snapshot.h"
#include "app/core/live/touchable_model.h"

namespace palpa::app {

/// Commands in, snapshots out, a step at a time and without a clock: what the touch loop and a
/// replay have in common, so that both give the same forces. Not thread-safe.
class TouchStepper {
 public:
  /// `number`: what snapshots call the body.
  explicit TouchStepper(std::shared_ptr<const TouchableModel> body, std::uint64_t number = 1);

  const TouchableModel& body() const { return *body_; }
  std::uint64_t number() const { return number_; }
  const bem::ContactSimulation& simulation() const { return simulation_; }

  /// False, and nothing happens, for contacts that are not there, are there already, or are more
  /// than a snapshot can hold.
  bool apply(const TouchCommand& command);
  /// Would one more contact of this kind fit?
  bool hasRoomFor(const bem::ContactTool& tool) const;
  void step() { simulation_.step(); }

  /// Takes over the contacts of a player of another body.
  void takeOver(const TouchStepper& other);
  /// The nodes whose columns the next step would miss.
  const std::vector<int>& missing() { return simulation_.missing(); }

  /// Fills in all but time and rate.
  void describe(TouchSnapshot& snapshot) const;

 private:
  struct Held {
    TouchId id;
    bem::ContactSimulation::Id inner;
  };
  std::vector<Held>::iterator find(TouchId id);

  std::shared_ptr<const TouchableModel> body_;
  std::uint64_t number_;
  bem::ContactSimulation simulation_;
  std::vector<Held> held_;  // in the order of the simulation's contacts
};

}  // namespace palpa::app
