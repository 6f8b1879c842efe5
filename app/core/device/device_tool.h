#pragma once

#include <memory>
#include <optional>

#include "app/core/device/device_protocol.h"
#include "app/core/device/device_target.h"
#include "app/core/device/handle_force.h"

namespace palpa::app {

/// The tool at the handle of one device: maps positions of the handle to the project, begins and
/// ends the contact with the body, and gives the force on the handle. One thread; without a clock.
///
/// The tool touches only after it has been outside of the body: at first, after a pressed clutch,
/// after a silence, and after something else has ended its contact (Escape in the window). So no
/// force appears under a hand that happens to be inside the body.
class DeviceTool {
 public:
  using Time = TouchLoop::Clock::time_point;

  /// `tool`: one that presses (kPush, kBall). The workspace of the hello is centred on the body
  /// that the target touches now, 1.5 times as large as the body; without a body it is not scaled.
  /// `target` must outlive the object.
  DeviceTool(DeviceTarget& target, const bem::ContactTool& tool, const DeviceHello& hello);
  /// Ends the contact.
  ~DeviceTool();
  DeviceTool(const DeviceTool&) = delete;
  DeviceTool& operator=(const DeviceTool&) = delete;

  /// How the handle's coordinates are mapped, without the motions of the clutch.
  const Eigen::Vector3d& origin() const { return origin_; }
  double scale() const { return scale_; }

  /// The force for the newest position of the handle.
  DeviceReply update(const DevicePosition& position, Time now);
  /// Ends the contact until the tool has been outside of the body again.
  void lift();
  bool isTouching() const { return contact_ != 0; }

 private:
  struct Place {
    double distance = 0;  // mm, from the undeformed surface to the tool; negative inside
    Eigen::Vector3d at = Eigen::Vector3d::Zero();  // nearest point of this surface
  };
  Place placeOf(const Eigen::Vector3d& tip) const;
  Eigen::Vector3d tipFor(const DevicePosition& position);
  /// Follows models and contacts of the target.
  void follow();
  void beginOrEnd(const Eigen::Vector3d& tip, DeviceReply& reply);
  /// The newest result for the contact, in the coordinates of the device.
  std::optional<SolvedContact> solved(DeviceReply& reply) const;

  DeviceTarget& target_;
  const bem::ContactTool tool_;
  const HandleLimits limits_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  double scale_ = 1;
  std::optional<Eigen::Vector3d> clutched_;  // where the tool stays while the clutch is pressed

  TouchSnapshot snapshot_;
  std::uint64_t number_ = 0;  // of model_
  std::shared_ptr<const TouchableModel> model_;
  TouchId contact_ = 0;   // 0: none
  bool isKnown_ = false;  // the loop has begun the contact
  bool wasOutside_ = false;
  HandleForce force_;
};

}  // namespace palpa::app
