#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"

/// Messages between a haptic device and Palpa: docs/device-protocol.md is the specification.
namespace palpa::app {

/// Why a connection ends; part of error messages.
enum class DeviceErrorCode : std::uint16_t {
  kBusy = 1,        ///< another device is connected
  kVersion = 2,     ///< no common version
  kBadMessage = 3,  ///< a message does not follow the protocol
  kSilent = 4,      ///< no message came for too long
  kClosing = 5,     ///< Palpa ends, or stops listening
  kSlow = 6,        ///< the device does not read its forces
};

/// A device or its program does not follow the protocol, or the socket cannot be used. The message
/// is for users.
class DeviceError : public Error {
 public:
  explicit DeviceError(const std::string& message,
                       DeviceErrorCode code = DeviceErrorCode::kBadMessage)
      : Error(message), code_(code) {}
  DeviceErrorCode code() const { return code_; }

 private:
  DeviceErrorCode code_;
};

constexpr std::uint16_t kDeviceVersion = 1;
constexpr std::size_t kDeviceMessageSize = 64;  ///< bytes of every message but kError
constexpr std::size_t kDeviceErrorSize = 256;   ///< bytes
using DeviceMessage = std::array<std::byte, kDeviceMessageSize>;

/// First message of a device.
struct DeviceHello {
  std::uint16_t minVersion = kDeviceVersion, maxVersion = kDeviceVersion;
  /// Edge lengths of the device's workspace about its origin, mm. Zero: positions are in the
  /// coordinates of the project.
  Eigen::Vector3d workspace = Eigen::Vector3d::Zero();
  double maxForce = 0;      ///< N, largest force that Palpa may ask for; 0: unlimited
  double maxStiffness = 0;  ///< N per mm of the device that it renders stably; 0: 3 N/mm
};

/// Answer to DeviceHello. Position in the project = origin + scale * position of the device.
struct DeviceWelcome {
  std::uint16_t version = kDeviceVersion;
  std::uint32_t timeoutMs = 0;                       ///< silence after which the tool is lifted
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< mm
  double scale = 1;
  double radius = 0;  ///< mm, of the tool
};

/// Position of the handle.
struct DevicePosition {
  static constexpr std::uint32_t kClutch = 1;          ///< bit of buttons
  std::uint64_t sequence = 0;                          ///< returned with the force
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< mm, of the device
  std::uint32_t buttons = 0;
  double time = 0;  ///< s, when it was read, by the clock of the device; 0: unknown
};

/// Force that the device must apply to the handle until the next one arrives.
struct DeviceReply {
  // Bits of status.
  static constexpr std::uint32_t kTouching = 1;  ///< the tool presses on the body
  static constexpr std::uint32_t kClutched = 2;  ///< the clutch is pressed
  static constexpr std::uint32_t kNoModel = 4;   ///< there is nothing to touch
  static constexpr std::uint32_t kWaiting = 8;   ///< the place is not computed yet
  static constexpr std::uint32_t kLifted = 16;   ///< the tool must leave the body before it touches
  static constexpr std::uint32_t kLimited = 32;  ///< below the body's force: limit, or passivity
  static constexpr std::uint32_t kRefused = 64;  ///< no contact is free for the device
  std::uint64_t sequence = 0;                    ///< of the position
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< N, on the handle
  std::uint32_t status = 0;
  std::uint32_t model = 0;  ///< number of the model; changes when the body was rebuilt
  double stiffness = 0;     ///< N per mm of the device
  double ageMs = 0;         ///< age of the solver's result that the force comes from, ms
};

DeviceMessage encode(const DeviceHello& hello);
DeviceMessage encode(const DeviceWelcome& welcome);
DeviceMessage encode(const DevicePosition& position);
DeviceMessage encode(const DeviceReply& reply);
/// The text is cut to 239 bytes.
std::array<std::byte, kDeviceErrorSize> encodeDeviceError(DeviceErrorCode code,
                                                          const std::string& text);

// Decoders check everything: type, ranges, finite numbers. Throw DeviceError.
DeviceHello decodeHello(const DeviceMessage& message);
DevicePosition decodePosition(const DeviceMessage& message);
DeviceWelcome decodeWelcome(const DeviceMessage& message);
DeviceReply decodeReply(const DeviceMessage& message);

/// Collects bytes of a stream into messages.
class DeviceStream {
 public:
  void add(std::span<const std::byte> bytes);
  /// The next complete message. Throws DeviceError as soon as eight bytes cannot begin a message of
  /// a device: other first bytes, another size.
  std::optional<DeviceMessage> next();
  bool isEmpty() const { return bytes_.size() == taken_; }

 private:
  std::vector<std::byte> bytes_;
  std::size_t taken_ = 0;
};

}  // namespace palpa::app
