#include "app/core/device/device_protocol.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

namespace palpa::app {
namespace {

using Eigen::Vector3d;

static_assert(std::endian::native == std::endian::little,
              "messages are little-endian; other machines must swap bytes here");
static_assert(sizeof(double) == 8 && std::numeric_limits<double>::is_iec559);

constexpr std::array<char, 4> kMagic{'P', 'A', 'L', 'P'};
constexpr double kMaxLength = 1e6;     // mm, of positions and workspaces
constexpr double kMaxForce = 1e6;      // N
constexpr double kMaxTime = 1e12;      // s
constexpr double kMaxStiffness = 1e9;  // N/mm

enum class Type : std::uint16_t { kHello = 1, kWelcome, kPosition, kForce, kError };

template <class Message, class Value>
void put(Message& message, std::size_t at, const Value& value) {
  std::memcpy(message.data() + at, &value, sizeof value);
}

template <class Value>
Value get(const DeviceMessage& message, std::size_t at) {
  Value value{};
  std::memcpy(&value, message.data() + at, sizeof value);
  return value;
}

void putVector(DeviceMessage& message, std::size_t at, const Vector3d& vector) {
  for (int k = 0; k < 3; ++k) put(message, at + 8 * static_cast<std::size_t>(k), vector[k]);
}

Vector3d getVector(const DeviceMessage& message, std::size_t at) {
  return {get<double>(message, at), get<double>(message, at + 8), get<double>(message, at + 16)};
}

template <class Message>
void putHead(Message& message, Type type) {
  put(message, 0, kMagic);
  put(message, 4, type);
  put(message, 6, static_cast<std::uint16_t>(message.size()));
}

DeviceMessage begin(Type type) {
  DeviceMessage message{};
  putHead(message, type);
  return message;
}

void expect(const DeviceMessage& message, Type type, const char* name) {
  const auto found = get<std::uint16_t>(message, 4);
  if (found != static_cast<std::uint16_t>(type))
    throw DeviceError("device: expected a " + std::string(name) + " message, found type " +
                      std::to_string(found));
}

}  // namespace

DeviceMessage encode(const DeviceHello& hello) {
  DeviceMessage message = begin(Type::kHello);
  put(message, 8, hello.minVersion);
  put(message, 10, hello.maxVersion);
  putVector(message, 16, hello.workspace);
  put(message, 40, hello.maxForce);
  put(message, 48, hello.maxStiffness);
  return message;
}

DeviceMessage encode(const DeviceWelcome& welcome) {
  DeviceMessage message = begin(Type::kWelcome);
  put(message, 8, welcome.version);
  put(message, 12, welcome.timeoutMs);
  putVector(message, 16, welcome.origin);
  put(message, 40, welcome.scale);
  put(message, 48, welcome.radius);
  return message;
}

DeviceMessage encode(const DevicePosition& position) {
  DeviceMessage message = begin(Type::kPosition);
  put(message, 8, position.sequence);
  putVector(message, 16, position.position);
  put(message, 40, position.buttons);
  put(message, 48, position.time);
  return message;
}

DeviceMessage encode(const DeviceReply& reply) {
  DeviceMessage message = begin(Type::kForce);
  put(message, 8, reply.sequence);
  putVector(message, 16, reply.force);
  put(message, 40, reply.status);
  put(message, 44, reply.model);
  put(message, 48, reply.stiffness);
  put(message, 56, reply.ageMs);
  return message;
}

std::array<std::byte, kDeviceErrorSize> encodeDeviceError(DeviceErrorCode code,
                                                          const std::string& text) {
  std::array<std::byte, kDeviceErrorSize> message{};
  putHead(message, Type::kError);
  put(message, 8, code);
  constexpr std::size_t kTextAt = 16;
  // The last byte stays zero.
  std::memcpy(message.data() + kTextAt, text.data(),
              std::min(text.size(), kDeviceErrorSize - kTextAt - 1));
  return message;
}

DeviceHello decodeHello(const DeviceMessage& message) {
  expect(message, Type::kHello, "hello");
  DeviceHello hello;
  hello.minVersion = get<std::uint16_t>(message, 8);
  hello.maxVersion = get<std::uint16_t>(message, 10);
  hello.workspace = getVector(message, 16);
  hello.maxForce = get<double>(message, 40);
  hello.maxStiffness = get<double>(message, 48);
  // Written so that NaN fails.
  const bool isGiven = (hello.workspace.array() > 0 && hello.workspace.array() <= kMaxLength).all();
  if (!isGiven && !hello.workspace.isZero(0))
    throw DeviceError(
        "device: the workspace must have three edge lengths above 0 and at most 1e6 mm, or three "
        "zeros");
  if (!(hello.maxForce >= 0 && hello.maxForce <= kMaxForce))
    throw DeviceError("device: the largest force must be 0 (unlimited) to 1e6 N");
  if (!(hello.maxStiffness >= 0 && hello.maxStiffness <= kMaxStiffness))
    throw DeviceError("device: the largest stiffness must be 0 (unknown) to 1e9 N/mm");
  return hello;
}

DevicePosition decodePosition(const DeviceMessage& message) {
  expect(message, Type::kPosition, "position");
  DevicePosition position{get<std::uint64_t>(message, 8), getVector(message, 16),
                          get<std::uint32_t>(message, 40), get<double>(message, 48)};
  if (!(position.position.array().abs() <= kMaxLength).all())
    throw DeviceError("device: a position has numbers that are not finite or above 1e6 mm");
  if (!(position.time >= 0 && position.time <= kMaxTime))
    throw DeviceError("device: the time of a position must be 0 (unknown) to 1e12 s");
  return position;
}

DeviceWelcome decodeWelcome(const DeviceMessage& message) {
  expect(message, Type::kWelcome, "welcome");
  return {get<std::uint16_t>(message, 8), get<std::uint32_t>(message, 12), getVector(message, 16),
          get<double>(message, 40), get<double>(message, 48)};
}

DeviceReply decodeReply(const DeviceMessage& message) {
  expect(message, Type::kForce, "force");
  return {get<std::uint64_t>(message, 8),  getVector(message, 16),
          get<std::uint32_t>(message, 40), get<std::uint32_t>(message, 44),
          get<double>(message, 48),        get<double>(message, 56)};
}

void DeviceStream::add(std::span<const std::byte> bytes) {
  // What next() returned is removed here, so that the vector stays small and keeps its memory.
  bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(taken_));
  taken_ = 0;
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

std::optional<DeviceMessage> DeviceStream::next() {
  constexpr std::size_t kHeadSize = 8;
  const std::size_t available = bytes_.size() - taken_;
  if (available < kHeadSize) return std::nullopt;
  DeviceMessage message{};
  const std::byte* from = bytes_.data() + taken_;
  std::memcpy(message.data(), from, kHeadSize);
  if (get<std::array<char, 4>>(message, 0) != kMagic)
    throw DeviceError("device: a message does not begin with the bytes PALP");
  if (const auto size = get<std::uint16_t>(message, 6); size != kDeviceMessageSize)
    throw DeviceError("device: a message says that it has " + std::to_string(size) +
                      " bytes; messages of devices have 64");
  if (available < kDeviceMessageSize) return std::nullopt;
  std::memcpy(message.data(), from, kDeviceMessageSize);
  taken_ += kDeviceMessageSize;
  return message;
}

}  // namespace palpa::app
