#pragma once

#include <cstdint>
#include <memory>

#include "app/core/live/touch_loop.h"

namespace palpa::app {

/// What a device touches: the functions of TouchLoop that it needs. Tests replace the loop by steps
/// without a clock.
class DeviceTarget {
 public:
  virtual ~DeviceTarget() = default;

  // As in TouchLoop.
  virtual TouchId begin(const bem::ContactTool& tool, const Eigen::Vector3d& at,
                        const Eigen::Vector3d& value) = 0;
  virtual void set(TouchId id, const Eigen::Vector3d& value) = 0;
  virtual void end(TouchId id) = 0;
  virtual void expect(const Eigen::Vector3d& point) = 0;
  virtual void read(TouchSnapshot& into) const = 0;
  virtual std::shared_ptr<const TouchableModel> model(std::uint64_t number) const = 0;
};

/// A running touch loop as the target of a device. The loop must outlive it.
class LoopTarget final : public DeviceTarget {
 public:
  explicit LoopTarget(TouchLoop& loop) : loop_(loop) {}

  TouchId begin(const bem::ContactTool& tool, const Eigen::Vector3d& at,
                const Eigen::Vector3d& value) override {
    return loop_.begin(tool, at, value);
  }
  void set(TouchId id, const Eigen::Vector3d& value) override { loop_.set(id, value); }
  void end(TouchId id) override { loop_.end(id); }
  void expect(const Eigen::Vector3d& point) override { loop_.expect(point); }
  void read(TouchSnapshot& into) const override { loop_.read(into); }
  std::shared_ptr<const TouchableModel> model(std::uint64_t number) const override {
    return loop_.model(number);
  }

 private:
  TouchLoop& loop_;
};

}  // namespace palpa::app
