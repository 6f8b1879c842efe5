#pragma once

#include <optional>
#include <span>
#include <vector>

#include "app/core/device/device_tool.h"

namespace palpa::app {

/// The conversation with one device: bytes in, bytes out, without a socket and without a clock.
class DeviceSession {
 public:
  using Time = DeviceTool::Time;
  static constexpr std::chrono::milliseconds kHelloTimeout{2000};  ///< until the hello
  static constexpr std::chrono::milliseconds kLiftTimeout{100};    ///< then the tool is lifted
  static constexpr std::chrono::milliseconds kEndTimeout{10'000};  ///< then the connection ends

  /// `target` must outlive the object.
  DeviceSession(DeviceTarget& target, const bem::ContactTool& tool, Time now)
      : target_(target), toolKind_(tool), heard_(now) {}

  /// Takes bytes of the device and appends the answers to `answers`. Throws DeviceError if they do
  /// not follow the protocol.
  void receive(std::span<const std::byte> bytes, Time now, std::vector<std::byte>& answers);
  /// To be called every few tens of milliseconds. Lifts the tool of a silent device; throws
  /// DeviceError if it has been silent for too long.
  void check(Time now);

  /// True after a valid hello.
  bool isGreeted() const { return tool_.has_value(); }
  bool isTouching() const { return tool_ && tool_->isTouching(); }
  /// Number of positions so far.
  std::uint64_t positions() const { return positions_; }

 private:
  void greet(const DeviceMessage& message, std::vector<std::byte>& answers);

  DeviceTarget& target_;
  const bem::ContactTool toolKind_;
  DeviceStream stream_;
  std::optional<DeviceTool> tool_;
  Time heard_;
  std::uint64_t positions_ = 0;
};

}  // namespace palpa::app
