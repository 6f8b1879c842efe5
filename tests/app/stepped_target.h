#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "app/core/device/device_target.h"
#include "app/core/live/touch_stepper.h"

namespace palpa::app::test {

/// Touch loop in simulated time: step() makes one step; read() gives the result of some steps ago,
/// as a device sees it. All columns that a step needs are computed.
class SteppedTarget final : public DeviceTarget {
 public:
  /// `lag`: steps from a position to the snapshot with its force.
  explicit SteppedTarget(std::shared_ptr<const TouchableModel> model, int lag = 2)
      : model_(std::move(model)), stepper_(model_), lag_(static_cast<std::size_t>(lag)) {
    snapshots_.emplace_back();
    stepper_.describe(snapshots_.back());
  }

  TouchId begin(const bem::ContactTool& tool, const Eigen::Vector3d& at,
                const Eigen::Vector3d& value) override {
    commands_.push_back({TouchCommand::Kind::kBegin, ++last_, tool, at, value});
    return last_;
  }
  void set(TouchId id, const Eigen::Vector3d& value) override {
    commands_.push_back({TouchCommand::Kind::kSet, id, {}, Eigen::Vector3d::Zero(), value});
  }
  void end(TouchId id) override {
    commands_.push_back(
        {TouchCommand::Kind::kEnd, id, {}, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
  }
  void expect(const Eigen::Vector3d&) override {}
  void read(TouchSnapshot& into) const override { into = snapshots_.front(); }
  std::shared_ptr<const TouchableModel> model(std::uint64_t) const override {
    return hasModel ? model_ : nullptr;
  }

  void step(TouchLoop::Clock::time_point now) {
    for (const TouchCommand& command : commands_) stepper_.apply(command);
    commands_.clear();
    while (!stepper_.missing().empty()) model_->columns()->compute(stepper_.missing(), {});
    stepper_.step();
    snapshots_.emplace_back();
    stepper_.describe(snapshots_.back());
    snapshots_.back().time = now;
    if (!hasModel) snapshots_.back().model = 0;
    while (snapshots_.size() > lag_) snapshots_.pop_front();
  }
  /// The newest snapshot.
  const TouchSnapshot& newest() const { return snapshots_.back(); }

  bool hasModel = true;

 private:
  std::shared_ptr<const TouchableModel> model_;
  TouchStepper stepper_;
  std::deque<TouchSnapshot> snapshots_;
  std::vector<TouchCommand> commands_;
  TouchId last_ = 0;
  std::size_t lag_;
};

}  // namespace palpa::app::test
