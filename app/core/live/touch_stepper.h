#pragma once

#include <memory>
#include <vector>

#include "app/core/live/touch_snapshot.h"
#include "app/core/live/touchable_model.h"

namespace palpa::app {

/// Turns commands into snapshots, one step at a time and without a clock: the common part of the
/// touch loop and of a replay, so that both give the same forces. Not thread-safe.
class TouchStepper {
 public:
  /// `number`: of the model, in snapshots.
  explicit TouchStepper(std::shared_ptr<const TouchableModel> model, std::uint64_t number = 1);

  const TouchableModel& model() const { return *model_; }
  std::uint64_t number() const { return number_; }
  const bem::ContactSimulation& simulation() const { return simulation_; }

  /// False, without effect, for a contact that does not exist, was begun already, or exceeds the
  /// capacity of a snapshot.
  bool apply(const TouchCommand& command);
  /// True if a snapshot has room for one more contact of this kind.
  bool hasRoomFor(const bem::ContactTool& tool) const;
  void step() { simulation_.step(); }

  /// Takes over the contacts of a stepper of another model.
  void takeOver(const TouchStepper& other);
  /// Nodes whose columns the next step needs and does not have.
  const std::vector<int>& missing() { return simulation_.missing(); }

  /// Fills in everything except time and rate.
  void describe(TouchSnapshot& snapshot) const;

 private:
  struct Contact {
    TouchId id;
    bem::ContactSimulation::Id inner;
  };
  std::vector<Contact>::iterator find(TouchId id);

  std::shared_ptr<const TouchableModel> model_;
  std::uint64_t number_;
  bem::ContactSimulation simulation_;
  std::vector<Contact> contacts_;  // in the order of the simulation's contacts
};

}  // namespace palpa::app
