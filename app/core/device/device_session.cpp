#include "app/core/device/device_session.h"

#include <algorithm>
#include <string>

namespace palpa::app {
namespace {

void append(const DeviceMessage& message, std::vector<std::byte>& answers) {
  answers.insert(answers.end(), message.begin(), message.end());
}

}  // namespace

void DeviceSession::receive(std::span<const std::byte> bytes, Time now,
                            std::vector<std::byte>& answers) {
  stream_.add(bytes);
  while (const auto message = stream_.next()) {
    heard_ = now;
    if (tool_) {
      append(encode(tool_->update(decodePosition(*message), now)), answers);
      ++positions_;
    } else {
      greet(*message, answers);
    }
  }
}

void DeviceSession::greet(const DeviceMessage& message, std::vector<std::byte>& answers) {
  const DeviceHello hello = decodeHello(message);
  if (kDeviceVersion < hello.minVersion || kDeviceVersion > hello.maxVersion)
    throw DeviceError("device: it speaks versions " + std::to_string(hello.minVersion) + " to " +
                          std::to_string(hello.maxVersion) +
                          " of the device protocol, this Palpa speaks version " +
                          std::to_string(kDeviceVersion) + "; update the older one",
                      DeviceErrorCode::kVersion);
  tool_.emplace(target_, toolKind_, hello);
  append(encode(DeviceWelcome{kDeviceVersion, static_cast<std::uint32_t>(kLiftTimeout.count()),
                              tool_->origin(), tool_->scale(), toolKind_.radius}),
         answers);
}

void DeviceSession::check(Time now) {
  const auto silent = now - heard_;
  if (!tool_) {
    if (silent > kHelloTimeout)
      throw DeviceError("device: no hello message came for 2 s", DeviceErrorCode::kSilent);
    return;
  }
  if (silent > kLiftTimeout && tool_->isTouching()) tool_->lift();
  if (silent > kEndTimeout)
    throw DeviceError("device: no position came for 10 s", DeviceErrorCode::kSilent);
}

}  // namespace palpa::app
