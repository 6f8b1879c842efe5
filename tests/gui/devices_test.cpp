// Haptic devices at the window.
#include <poll.h>

#include <QLabel>
#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <thread>

#include "app/core/device/local_socket.h"
#include "app/gui/docks/forces_dock.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

class Devices : public WindowTest {
 protected:
  Devices() {
    std::filesystem::create_directory(runtime());
    qputenv("XDG_RUNTIME_DIR", runtime().c_str());
  }
  ~Devices() override { qunsetenv("XDG_RUNTIME_DIR"); }

  Simulation& simulation() { return window_->simulation(); }
  std::filesystem::path runtime() const {
    return std::filesystem::path(folder_.path().toStdString()) / "run";
  }
  std::filesystem::path socket() const { return runtime() / "palpa/device.sock"; }
  void enter() {
    ASSERT_TRUE(window_->openFile(kSphere));
    waitForModel();
    action("Listen for a device")->trigger();  // starts Simulate mode
    ASSERT_TRUE(simulation().isActive());
    ASSERT_TRUE(QTest::qWaitFor([&] { return simulation().drawn() != nullptr; }, 20000));
    QTest::qWait(50);
  }
  QString said() { return window_->messages().messages().join('\n'); }
  QString label() {
    auto* found = find<QLabel>("deviceStatus");
    return found && found->isVisible() ? found->text() : QString();
  }

  static std::vector<std::byte> receive(const app::FileDescriptor& from, std::size_t size) {
    std::vector<std::byte> bytes;
    std::array<std::byte, 512> part;
    while (bytes.size() < size) {
      pollfd waited{from.number(), POLLIN, 0};
      if (::poll(&waited, 1, 30'000) != 1) break;
      const auto count =
          app::receiveSome(from, std::span(part).first(std::min(part.size(), size - bytes.size())));
      if (count == 0) break;
      if (count) bytes.insert(bytes.end(), part.begin(), part.begin() + static_cast<long>(*count));
    }
    return bytes;
  }
  static app::DeviceMessage message(const app::FileDescriptor& from) {
    app::DeviceMessage result{};
    const auto bytes = receive(from, result.size());
    EXPECT_EQ(bytes.size(), result.size());
    std::copy_n(bytes.begin(), std::min(bytes.size(), result.size()), result.begin());
    return result;
  }
  app::FileDescriptor greeted() {
    app::FileDescriptor device = app::connectTo(socket());
    app::sendSome(device, encode(app::DeviceHello{1, 1, {0, 0, 0}, 0, 1e6}));
    EXPECT_EQ(app::decodeWelcome(message(device)).version, 1);
    return device;
  }
  app::DeviceReply ask(const app::FileDescriptor& device, const Eigen::Vector3d& position) {
    app::sendSome(device, encode(app::DevicePosition{++sequence_, position, 0}));
    return app::decodeReply(message(device));
  }
  /// Asks each millisecond, beside the window, until a condition holds.
  app::DeviceReply askUntil(const app::FileDescriptor& device, const Eigen::Vector3d& position,
                            const std::function<bool(const app::DeviceReply&)>& condition) {
    std::mutex mutex;
    app::DeviceReply newest, reply;
    const std::jthread hand([&](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        const app::DeviceReply next = ask(device, position);
        {
          const std::lock_guard lock(mutex);
          newest = next;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    });
    EXPECT_TRUE(QTest::qWaitFor(
        [&] {
          const std::lock_guard lock(mutex);
          reply = newest;
          return reply.sequence > 0 && condition(reply);
        },
        20000))
        << "status " << reply.status << ", force " << reply.force.norm();
    return reply;
  }
  void press(const app::FileDescriptor& device) {
    askUntil(device, {0, 0, 27}, [](const app::DeviceReply& reply) {
      return reply.status == 0 && reply.stiffness > 0;
    });
    askUntil(device, {0, 0, 23}, [&](const app::DeviceReply& reply) {
      const auto touched = simulation().snapshot().touched();
      return reply.force.norm() > 0.1 && touched.size() == 1 &&
             (touched.front().force + reply.force).norm() < 1e-3 * reply.force.norm();
    });
  }

  std::uint64_t sequence_ = 0;
};

TEST_F(Devices, ADeviceFeelsTheForceThatTheWindowShows) {
  enter();
  EXPECT_TRUE(said().contains("Listening for a device at"));
  EXPECT_EQ(label(), "Waiting for a device");
  const app::FileDescriptor device = greeted();
  ASSERT_TRUE(QTest::qWaitFor([&] { return said().contains("A device is connected"); }, 5000));
  press(device);
  auto* forces = find<ForcesDock>("forces");
  ASSERT_TRUE(forces);
  askUntil(device, {0, 0, 23},
           [&](const app::DeviceReply&) { return forces->text(0, 0).startsWith("Push 1"); });
  askUntil(device, {0, 0, 23},
           [&](const app::DeviceReply&) { return label().startsWith("Device: "); });
  keepPicture("device-press");
  EXPECT_FALSE(simulation().isOwn(simulation().snapshot().touched().front().id));
}

TEST_F(Devices, EscapeLiftsTheToolAndModelModeEndsTheForce) {
  enter();
  const app::FileDescriptor device = greeted();
  press(device);
  QTest::keyClick(&view(), Qt::Key_Escape);
  askUntil(device, {0, 0, 23}, [](const app::DeviceReply& reply) {
    return reply.status == app::DeviceReply::kLifted && reply.force.isZero();
  });
  press(device);
  action("Model")->trigger();
  askUntil(device, {0, 0, 23}, [](const app::DeviceReply& reply) {
    return reply.status == app::DeviceReply::kNoModel && reply.force.isZero();
  });
  action("Simulate")->trigger();
  press(device);  // the same connection
}

TEST_F(Devices, TheEndOfTheDeviceOrOfListeningIsSaid) {
  enter();
  app::FileDescriptor device = greeted();
  ask(device, {0, 0, 40});
  device = app::FileDescriptor();
  ASSERT_TRUE(QTest::qWaitFor([&] { return said().contains("The device has left"); }, 5000));
  EXPECT_EQ(label(), "Waiting for a device");
  device = greeted();
  ask(device, {0, 0, 40});
  action("Listen for a device")->trigger();
  const auto last = receive(device, app::kDeviceErrorSize);
  ASSERT_EQ(last.size(), app::kDeviceErrorSize);
  EXPECT_EQ(std::to_integer<int>(last[8]), static_cast<int>(app::DeviceErrorCode::kClosing));
  EXPECT_EQ(label(), "");
  EXPECT_FALSE(std::filesystem::exists(socket()));
}

TEST_F(Devices, AWrongProgramIsNamedAndTheNextOneIsWelcome) {
  enter();
  {
    const app::FileDescriptor device = greeted();
    const std::array<std::byte, 64> zeros{};
    app::sendSome(device, zeros);
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return said().contains("device: a message does not begin with the bytes PALP"); },
        5000));
  }
  ask(greeted(), {0, 0, 40});
}

TEST_F(Devices, WithoutASafePlaceThereIsAReason) {
  ASSERT_TRUE(window_->openFile(kSphere));
  waitForModel();
  std::filesystem::create_directory(socket().parent_path());
  std::filesystem::permissions(socket().parent_path(), std::filesystem::perms::all);
  action("Listen for a device")->trigger();
  EXPECT_FALSE(action("Listen for a device")->isChecked());
  EXPECT_TRUE(said().contains("others can use this folder"));
  EXPECT_EQ(label(), "");
}

TEST_F(Devices, TheWindowClosesWhileADevicePresses) {
  enter();
  const app::FileDescriptor device = greeted();
  press(device);
  restart();
  const auto last = receive(device, app::kDeviceErrorSize);
  EXPECT_EQ(last.size(), app::kDeviceErrorSize);
}

}  // namespace
}  // namespace palpa::gui
