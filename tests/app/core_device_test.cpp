// Messages, tool, and server of devices.
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <thread>

#include "app/core/device/device_server.h"
#include "app/core/model/build_touch_model.h"
#include "app/core/results/touch.h"
#include "tests/app/core_projects.h"
#include "tests/app/stepped_target.h"

namespace palpa::app {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Eigen::Vector3d;
using Kind = bem::ContactTool::Kind;

const Vector3d kTop(0, 0, 25);
const bem::ContactTool kFinger{Kind::kPush, 8, 0};

const std::shared_ptr<const TouchModel>& sphere() {
  static const auto shared = buildTouchModel(test::clampedSphere(6), {}, {});
  return shared;
}

/// The force on the body of a fingertip at a position above the top, from the exact solver.
Vector3d exactForce(const Vector3d& tip) {
  const modeling::Touch touch{"exact", kTop, modeling::TouchKind::kPush, tip - kTop, 8.0};
  return playTouches(*sphere(), std::span(&touch, 1)).contacts[0].force;
}

template <class Bytes>
std::vector<std::byte> bytesOf(const Bytes& bytes) {
  return {bytes.begin(), bytes.end()};
}

std::string messageOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const DeviceError& error) {
    return error.what();
  }
  return {};
}

TEST(DeviceProtocol, HasTheSpecifiedBytes) {
  const DeviceMessage message = encode(DevicePosition{0x0102030405060708, {1, -2, 0.5}, 1, 2});
  const unsigned char expected[64] = {'P', 'A', 'L', 'P', 3, 0, 64,   0,     // head
                                      8,   7,   6,   5,   4, 3, 2,    1,     // sequence
                                      0,   0,   0,   0,   0, 0, 0xf0, 0x3f,  // 1
                                      0,   0,   0,   0,   0, 0, 0,    0xc0,  // -2
                                      0,   0,   0,   0,   0, 0, 0xe0, 0x3f,  // 0.5
                                      1,   0,   0,   0,   0, 0, 0,    0,     // clutch
                                      0,   0,   0,   0,   0, 0, 0,    0x40};
  EXPECT_EQ(std::memcmp(message.data(), expected, sizeof expected), 0);
}

TEST(DeviceProtocol, ReturnsWhatWasSent) {
  const DeviceHello hello = decodeHello(encode(DeviceHello{1, 3, {100, 80, 60}, 3.5, 2.5}));
  EXPECT_EQ(hello.minVersion, 1);
  EXPECT_EQ(hello.maxVersion, 3);
  EXPECT_EQ(hello.workspace, Vector3d(100, 80, 60));
  EXPECT_EQ(hello.maxForce, 3.5);
  EXPECT_EQ(hello.maxStiffness, 2.5);
  const DeviceWelcome welcome = decodeWelcome(encode(DeviceWelcome{1, 100, {1, 2, 3}, 0.5, 8}));
  EXPECT_EQ(welcome.timeoutMs, 100u);
  EXPECT_EQ(welcome.origin, Vector3d(1, 2, 3));
  EXPECT_EQ(welcome.scale, 0.5);
  EXPECT_EQ(welcome.radius, 8);
  const DeviceReply reply = decodeReply(encode(DeviceReply{7, {1, 2, 3}, 33, 2, 0.25, 1.5}));
  EXPECT_EQ(reply.sequence, 7u);
  EXPECT_EQ(reply.force, Vector3d(1, 2, 3));
  EXPECT_EQ(reply.status, 33u);
  EXPECT_EQ(reply.model, 2u);
  EXPECT_EQ(reply.stiffness, 0.25);
  EXPECT_EQ(reply.ageMs, 1.5);
}

TEST(DeviceProtocol, RefusesWrongValues) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(decodePosition(encode(DevicePosition{1, {0, kNan, 0}, 0})), DeviceError);
  EXPECT_THROW(decodePosition(encode(DevicePosition{1, {0, 0, 1e7}, 0})), DeviceError);
  EXPECT_THROW(decodePosition(encode(DevicePosition{1, {0, 0, 0}, 0, kNan})), DeviceError);
  EXPECT_THROW(decodePosition(encode(DevicePosition{1, {0, 0, 0}, 0, -1})), DeviceError);
  EXPECT_THROW(decodeHello(encode(DeviceHello{1, 1, {1, 0, 1}, 0, 0})), DeviceError);
  EXPECT_THROW(decodeHello(encode(DeviceHello{1, 1, {kNan, 1, 1}, 0, 0})), DeviceError);
  EXPECT_THROW(decodeHello(encode(DeviceHello{1, 1, {1, 1, 1}, -1, 0})), DeviceError);
  EXPECT_THROW(decodeHello(encode(DeviceHello{1, 1, {1, 1, 1}, 1, kNan})), DeviceError);
  EXPECT_EQ(messageOf([] { decodeHello(encode(DevicePosition{})); }),
            "device: expected a hello message, found type 3");
}

TEST(DeviceStream, PutsMessagesTogetherFromAnyParts) {
  std::vector<std::byte> sent;
  for (std::uint64_t k = 1; k <= 5; ++k)
    for (const std::byte byte : encode(DevicePosition{k, {0, 0, 0}, 0})) sent.push_back(byte);
  for (const std::size_t part : {std::size_t{1}, std::size_t{7}, std::size_t{100}, sent.size()}) {
    DeviceStream stream;
    std::uint64_t count = 0;
    for (std::size_t at = 0; at < sent.size(); at += part) {
      stream.add(std::span(sent).subspan(at, std::min(part, sent.size() - at)));
      while (const auto message = stream.next())
        EXPECT_EQ(decodePosition(*message).sequence, ++count);
    }
    EXPECT_EQ(count, 5u);
    EXPECT_TRUE(stream.isEmpty());
  }
}

TEST(DeviceStream, StopsAtTheFirstBytesThatAreNoMessage) {
  DeviceStream stream;
  const std::string text = "GET / HTTP/1.1\r\n";
  stream.add(std::as_bytes(std::span(text)));
  EXPECT_EQ(messageOf([&] { stream.next(); }),
            "device: a message does not begin with the bytes PALP");
  DeviceStream other;
  DeviceMessage message = encode(DevicePosition{});
  message[6] = std::byte{65};
  other.add(message);
  EXPECT_EQ(messageOf([&] { other.next(); }),
            "device: a message says that it has 65 bytes; messages of devices have 64");
}

/// A tool on the sphere, without a clock.
class DeviceToolTest : public testing::Test {
 protected:
  DeviceReply move(const Vector3d& position, std::uint32_t buttons = 0, int count = 1) {
    DeviceReply reply;
    for (int k = 0; k < count; ++k) {
      const DeviceTool::Time now{std::chrono::milliseconds(++time_)};
      reply = tool_.update({static_cast<std::uint64_t>(time_), position, buttons}, now);
      target_.step(now);
    }
    return reply;
  }
  std::shared_ptr<const TouchableModel> model_ = std::make_shared<TouchableModel>(sphere());
  test::SteppedTarget target_{model_};
  DeviceTool tool_{target_, kFinger, DeviceHello{1, 1, {0, 0, 0}, 0, 1e6}};
  int time_ = 0;
};

TEST_F(DeviceToolTest, GivesTheForceOfTheExactSolver) {
  move({0, 0, 27});
  for (double z = 27; z > 23; z -= 0.1) move({0, 0, z});
  const DeviceReply reply = move({0, 0, 23}, 0, 300);
  EXPECT_EQ(reply.status, DeviceReply::kTouching);
  const Vector3d exact = exactForce({0, 0, 23});
  EXPECT_GT(exact.norm(), 1);
  EXPECT_LT((reply.force + exact).norm(), 1e-3 * exact.norm());
  EXPECT_NEAR(reply.stiffness, exact.norm() / 2, 0.02 * reply.stiffness);
  EXPECT_TRUE(tool_.isTouching());
}

TEST_F(DeviceToolTest, AHandInsideTheBodyFeelsNothingUntilItWasOutside) {
  DeviceReply reply = move({0, 0, 20}, 0, 50);
  EXPECT_EQ(reply.status, DeviceReply::kLifted);
  EXPECT_EQ(reply.force, Vector3d::Zero());
  move({0, 0, 26}, 0, 5);
  reply = move({0, 0, 24}, 0, 300);
  EXPECT_EQ(reply.status, DeviceReply::kTouching);
}

TEST_F(DeviceToolTest, TheClutchMovesTheHandleWithoutTheTool) {
  move({0, 0, 26}, 0, 5);
  move({0, 0, 24}, 0, 300);
  DeviceReply reply = move({0, 0, 24}, DevicePosition::kClutch, 20);
  EXPECT_EQ(reply.status, DeviceReply::kClutched);
  EXPECT_EQ(reply.force, Vector3d::Zero());
  EXPECT_EQ(target_.newest().contactCount, 0);
  // The handle moves by 10 mm; the tool is still 1 mm inside, and must leave first.
  move({0, 0, 34}, DevicePosition::kClutch, 20);
  reply = move({0, 0, 34});
  EXPECT_EQ(reply.status, DeviceReply::kLifted);
  move({0, 0, 36}, 0, 5);  // 26 mm
  reply = move({0, 0, 33}, 0, 300);
  EXPECT_EQ(reply.status, DeviceReply::kTouching);
  const Vector3d exact = exactForce({0, 0, 23});
  EXPECT_LT((reply.force + exact).norm(), 1e-3 * exact.norm());
}

TEST_F(DeviceToolTest, AContactEndedBySomethingElseIsLifted) {
  move({0, 0, 26}, 0, 5);
  move({0, 0, 24}, 0, 100);
  ASSERT_EQ(target_.newest().contactCount, 1);
  target_.end(target_.newest().touched().front().id);
  const DeviceReply reply = move({0, 0, 24}, 0, 20);
  EXPECT_EQ(reply.status, DeviceReply::kLifted);
  EXPECT_EQ(target_.newest().contactCount, 0);
}

TEST_F(DeviceToolTest, WithoutAModelThereIsNoForce) {
  move({0, 0, 26}, 0, 5);
  move({0, 0, 24}, 0, 100);
  target_.hasModel = false;
  DeviceReply reply = move({0, 0, 24}, 0, 20);
  EXPECT_EQ(reply.status, DeviceReply::kNoModel);
  EXPECT_EQ(reply.force, Vector3d::Zero());
  EXPECT_EQ(reply.model, 0u);
  target_.hasModel = true;
  reply = move({0, 0, 24}, 0, 20);
  EXPECT_EQ(reply.status, DeviceReply::kLifted);
}

TEST_F(DeviceToolTest, FarFromTheBodyThereIsNoContact) {
  move({0, 0, 26}, 0, 5);
  EXPECT_EQ(target_.newest().contactCount, 1);
  move({0, 0, 100}, 0, 5);
  EXPECT_EQ(target_.newest().contactCount, 0);
  move({0, 0, 26}, 0, 5);
  EXPECT_EQ(target_.newest().contactCount, 1);
}

TEST_F(DeviceToolTest, TheWorkspaceSurroundsTheBody) {
  DeviceTool mapped(target_, kFinger, DeviceHello{1, 1, {150, 100, 75}, 0, 0});
  EXPECT_LT(mapped.origin().norm(), 1e-6);
  EXPECT_NEAR(mapped.scale(), 1.5 * 50 / 75, 1e-3);
}

TEST_F(DeviceToolTest, AMappedHandleFeelsTheSameForces) {
  DeviceTool mapped(target_, kFinger, DeviceHello{1, 1, {100, 100, 100}, 0, 1e6});
  const double scale = mapped.scale();
  DeviceReply reply;
  for (int k = 0; k < 400; ++k) {
    const DeviceTool::Time now{std::chrono::milliseconds(++time_)};
    const double z = std::max(27 - 0.05 * k, 23.0);
    reply = mapped.update({1, Vector3d(0, 0, z / scale) - mapped.origin() / scale, 0}, now);
    target_.step(now);
  }
  const Vector3d exact = exactForce({0, 0, 23});
  EXPECT_LT((reply.force + exact).norm(), 1e-3 * exact.norm());
  EXPECT_NEAR(reply.stiffness, scale * exact.norm() / 2, 0.02 * reply.stiffness);
}

/// A folder for sockets, a loop on the sphere, and a server.
class DeviceServerTest : public testing::Test {
 protected:
  DeviceServerTest() {
    std::string pattern = (fs::temp_directory_path() / "palpa-device-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    loop_.setModel(sphere());
    server_ = std::make_unique<DeviceServer>(target_, kFinger, socket());
  }
  ~DeviceServerTest() override {
    server_.reset();
    fs::remove_all(folder_);
  }
  fs::path socket() const { return folder_ / "device.sock"; }

  static void send(const FileDescriptor& to, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      const auto count = sendSome(to, bytes);
      ASSERT_TRUE(count);
      bytes = bytes.subspan(*count);
    }
  }
  /// Everything up to `size` bytes, or to the end of the connection.
  static std::vector<std::byte> receive(const FileDescriptor& from, std::size_t size) {
    std::vector<std::byte> bytes;
    std::array<std::byte, 4096> part;
    while (bytes.size() < size) {
      pollfd waited{from.number(), POLLIN, 0};
      if (::poll(&waited, 1, 60'000) != 1) {
        ADD_FAILURE() << "no answer for a minute";
        break;
      }
      const auto count =
          receiveSome(from, std::span(part).first(std::min(part.size(), size - bytes.size())));
      if (count == 0) break;
      if (count) bytes.insert(bytes.end(), part.begin(), part.begin() + static_cast<long>(*count));
    }
    return bytes;
  }
  static DeviceMessage message(const FileDescriptor& from) {
    const auto bytes = receive(from, kDeviceMessageSize);
    DeviceMessage result{};
    EXPECT_EQ(bytes.size(), result.size());
    std::copy_n(bytes.begin(), std::min(bytes.size(), result.size()), result.begin());
    return result;
  }
  /// Code and text of an error message that ends the connection.
  static std::pair<int, std::string> error(const FileDescriptor& from) {
    const auto bytes = receive(from, 10 * kDeviceErrorSize);
    if (bytes.size() != kDeviceErrorSize || bytes[4] != std::byte{5})
      return {0, "no error message: " + std::to_string(bytes.size()) + " bytes"};
    return {std::to_integer<int>(bytes[8]), reinterpret_cast<const char*>(bytes.data() + 16)};
  }
  FileDescriptor greeted() {
    FileDescriptor client = connectTo(socket());
    send(client, encode(DeviceHello{1, 1, {0, 0, 0}, 0, 1e6}));
    EXPECT_EQ(decodeWelcome(message(client)).version, 1);
    return client;
  }
  DeviceReply ask(const FileDescriptor& client, const Vector3d& position) {
    send(client, encode(DevicePosition{++sequence_, position, 0}));
    const DeviceReply reply = decodeReply(message(client));
    EXPECT_EQ(reply.sequence, sequence_);
    return reply;
  }
  /// Asks until the reply fulfils a condition.
  DeviceReply askUntil(const FileDescriptor& client, const Vector3d& position,
                       const std::function<bool(const DeviceReply&)>& condition) {
    DeviceReply reply;
    for (int k = 0; k < 60'000; ++k) {
      reply = ask(client, position);
      if (condition(reply)) return reply;
      std::this_thread::sleep_for(1ms);
    }
    ADD_FAILURE() << "status " << reply.status << ", force " << reply.force.norm();
    return reply;
  }
  void await(const std::function<bool()>& condition) {
    for (int k = 0; k < 60'000; ++k) {
      if (condition()) return;
      std::this_thread::sleep_for(1ms);
    }
    ADD_FAILURE() << "waited for a minute";
  }

  fs::path folder_;
  TouchLoop loop_;
  LoopTarget target_{loop_};
  std::unique_ptr<DeviceServer> server_;
  std::uint64_t sequence_ = 0;
};

TEST_F(DeviceServerTest, ADeviceFeelsTheForceOfTheExactSolver) {
  const FileDescriptor client = greeted();
  askUntil(client, {0, 0, 26},
           [](const DeviceReply& reply) { return reply.status == 0 && reply.stiffness > 0; });
  const Vector3d exact = exactForce({0, 0, 23});
  const DeviceReply reply = askUntil(client, {0, 0, 23}, [&](const DeviceReply& each) {
    return (each.force + exact).norm() < 1e-3 * exact.norm();
  });
  EXPECT_EQ(reply.status, DeviceReply::kTouching);
  EXPECT_TRUE(server_->status().isConnected);
  EXPECT_EQ(server_->status().devices, 1);
  EXPECT_GT(server_->latency().count, 0u);
}

TEST_F(DeviceServerTest, ASecondDeviceIsRefused) {
  const FileDescriptor first = greeted();
  const FileDescriptor second = connectTo(socket());
  const auto [code, text] = error(second);
  EXPECT_EQ(code, 1);
  EXPECT_EQ(text, "another device is connected to this Palpa; end it first");
  ask(first, {0, 0, 30});
}

TEST_F(DeviceServerTest, WrongBeginningsGetAReason) {
  {
    const FileDescriptor client = connectTo(socket());
    const std::string text = "hello, are you there?";
    send(client, std::as_bytes(std::span(text)));
    EXPECT_EQ(error(client).first, 3);
  }
  await([&] { return !server_->status().error.empty(); });
  {
    const FileDescriptor client = connectTo(socket());
    send(client, encode(DeviceHello{2, 5, {0, 0, 0}, 0, 0}));
    const auto [code, text] = error(client);
    EXPECT_EQ(code, 2);
    EXPECT_EQ(text,
              "device: it speaks versions 2 to 5 of the device protocol, this Palpa speaks version "
              "1; update the older one");
  }
  {
    const FileDescriptor client = greeted();
    send(client, encode(DevicePosition{1, {std::numeric_limits<double>::infinity(), 0, 0}, 0}));
    EXPECT_EQ(error(client).first, 3);
  }
  const FileDescriptor client = greeted();  // the next one is welcome
  ask(client, {0, 0, 30});
}

TEST_F(DeviceServerTest, ADeviceThatSaysNothingLosesItsPlace) {
  const FileDescriptor client = connectTo(socket());
  const DeviceMessage hello = encode(DeviceHello{});
  send(client, std::span(hello).first(20));  // and the rest never comes
  EXPECT_EQ(error(client), std::pair(4, std::string("device: no hello message came for 2 s")));
}

TEST_F(DeviceServerTest, ASilentOrDeadDeviceLeavesNoContact) {
  TouchSnapshot snapshot;
  const auto isFree = [&] {
    loop_.read(snapshot);
    return snapshot.contactCount == 0;
  };
  FileDescriptor client = greeted();
  const auto press = [&] {
    askUntil(client, {0, 0, 26}, [](const DeviceReply& reply) { return reply.stiffness > 0; });
    askUntil(client, {0, 0, 24}, [](const DeviceReply& reply) { return reply.force.norm() > 1; });
  };
  press();
  await(isFree);  // after 100 ms
  EXPECT_EQ(ask(client, {0, 0, 24}).status, DeviceReply::kLifted);
  press();
  client = FileDescriptor();
  await(isFree);
  await([&] { return server_->status().ended == 1; });
  EXPECT_FALSE(server_->status().isConnected);
  EXPECT_EQ(server_->status().error, "");
}

TEST_F(DeviceServerTest, ADeviceThatDoesNotReadIsDisconnected) {
  const FileDescriptor client = greeted();
  const DeviceMessage position = encode(DevicePosition{1, {0, 0, 30}, 0});
  for (int k = 0; k < 1'000'000 && sendSome(client, position) == position.size(); ++k) {
  }
  await([&] { return server_->status().ended == 1; });
  EXPECT_EQ(server_->status().error, "device: it does not read the forces that it asks for");
}

TEST_F(DeviceServerTest, TheEndOfPalpaIsSaid) {
  const FileDescriptor client = greeted();
  ask(client, {0, 0, 30});
  server_.reset();
  EXPECT_EQ(error(client), std::pair(5, std::string("Palpa stops listening for devices")));
  EXPECT_FALSE(fs::exists(socket()));
}

TEST_F(DeviceServerTest, TheSocketIsForItsOwnerAndForOneServer) {
  struct stat found {};
  ASSERT_EQ(::stat(socket().c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 0777U, 0600U);
  EXPECT_EQ(messageOf([&] { DeviceServer(target_, kFinger, socket()); }),
            socket().string() +
                ": another Palpa listens for a device here; end it, or choose another name");
  EXPECT_TRUE(fs::exists(socket()));
}

TEST_F(DeviceServerTest, ASocketLeftBehindIsReplaced) {
  // As a killed program leaves it: bound, and nobody listens.
  const fs::path hard = folder_ / "kept";
  fs::create_hard_link(socket(), hard);
  server_.reset();
  fs::rename(hard, socket());
  server_ = std::make_unique<DeviceServer>(target_, kFinger, socket());
  ask(greeted(), {0, 0, 30});
}

TEST_F(DeviceServerTest, WrongPathsAreRefused) {
  const fs::path file = folder_ / "file";
  std::ofstream(file) << "text";
  EXPECT_EQ(
      messageOf([&] { ListeningSocket{file}; }),
      file.string() + ": this file exists and is no socket; remove it, or choose another name");
  EXPECT_TRUE(fs::exists(file));
  EXPECT_NE(messageOf([&] {
              ListeningSocket{folder_ / std::string(120, 'x')};
            }).find("must have 1 to 107 bytes; choose another folder"),
            std::string::npos);
  EXPECT_NE(messageOf([&] {
              ListeningSocket{folder_ / "no/such/folder"};
            }).find("cannot listen for a device here: No such file or directory"),
            std::string::npos);
  EXPECT_NE(messageOf([&] { connectTo(folder_ / "nothing"); }).find("no Palpa listens here"),
            std::string::npos);
}

TEST(UsualDeviceSocket, LiesInAFolderOfTheUsers) {
  std::string pattern = (fs::temp_directory_path() / "palpa-runtime-XXXXXX").string();
  const fs::path folder = mkdtemp(pattern.data());
  ::setenv("XDG_RUNTIME_DIR", folder.c_str(), 1);
  EXPECT_EQ(usualDeviceSocket(), folder / "palpa/device.sock");
  struct stat found {};
  ASSERT_EQ(::stat((folder / "palpa").c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 0777U, 0700U);
  ::chmod((folder / "palpa").c_str(), 0755);
  EXPECT_NE(messageOf([] { usualDeviceSocket(); }).find("others can use this folder"),
            std::string::npos);
  ::unsetenv("XDG_RUNTIME_DIR");
  fs::remove_all(folder);
}

}  // namespace
}  // namespace palpa::app
