// A 3-D mouse: the test plays the daemon spacenavd, with version 0 of its protocol.
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

using Eigen::Vector3d;

/// A daemon without a mouse: sends the events that a test wants.
class Daemon {
 public:
  explicit Daemon(const QString& path) : path_(path.toUtf8()) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path_.constData(), sizeof address.sun_path - 1);
    listener_ = ::socket(AF_UNIX, SOCK_STREAM, 0);
    EXPECT_EQ(::bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(::listen(listener_, 4), 0);
  }
  ~Daemon() {
    hangUp();
    ::close(listener_);
    ::unlink(path_.constData());
  }
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;

  /// Waits until the window is connected.
  bool accept() {
    return QTest::qWaitFor(
        [this] {
          client_ = ::accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK);
          return client_ >= 0;
        },
        20000);
  }
  void acceptNonblocking() { ::fcntl(listener_, F_SETFL, O_NONBLOCK); }
  /// Like a cap that is held for a time: an event each 16 ms.
  void hold(const Vector3d& push, const Vector3d& turn, int events) {
    for (int k = 0; k < events; ++k) {
      send({0, toInt(push.x()), toInt(push.y()), toInt(push.z()), toInt(turn.x()), toInt(turn.y()),
            toInt(turn.z()), 16});
      QTest::qWait(2);
    }
    QTest::qWait(50);
  }
  void click(int button) {
    send({1, button, 0, 0, 0, 0, 0, 0});
    send({2, button, 0, 0, 0, 0, 0, 0});
    QTest::qWait(50);
  }
  void hangUp() {
    if (client_ >= 0) ::close(client_);
    client_ = -1;
  }
  /// True if the window has closed the connection.
  bool isLeft() const {
    std::array<char, 256> bytes;
    ssize_t count = 0;
    do count = ::recv(client_, bytes.data(), bytes.size(), MSG_DONTWAIT);
    while (count > 0);
    return count == 0;
  }

 private:
  static int toInt(double value) { return static_cast<int>(std::lround(value)); }
  void send(const std::array<int, 8>& event) const {
    EXPECT_EQ(::send(client_, event.data(), sizeof event, MSG_NOSIGNAL),
              static_cast<ssize_t>(sizeof event));
  }
  QByteArray path_;
  int listener_ = -1, client_ = -1;
};

class Mouse3dInWindow : public WindowTest {
 protected:
  Mouse3dInWindow() { qputenv("SPNAV_SOCKET", path().toUtf8()); }
  ~Mouse3dInWindow() override { qunsetenv("SPNAV_SOCKET"); }

  QString path() const { return folder_.path() + "/spnav.sock"; }
  void open(Daemon& daemon) {
    daemon.acceptNonblocking();
    restart();  // connects at the start
    ASSERT_TRUE(daemon.accept());
    ASSERT_TRUE(window_->openFile(kSphere));
    waitForModel();
  }
  view::CameraView camera() { return view().viewport().camera(); }
};

TEST_F(Mouse3dInWindow, TheBodyFollowsTheCap) {
  Daemon daemon(path());
  open(daemon);
  keepPicture("mouse-3d-before");
  const view::CameraView before = camera();
  // Twisted to the left, seen from above: the near side of the body moves to the right.
  const Vector3d right = before.direction.cross(before.up);
  daemon.hold({0, 0, 0}, {0, 350, 0}, 20);
  const view::CameraView turned = camera();
  EXPECT_NEAR(turned.direction.z(), before.direction.z(), 1e-9);
  // 2.1 rad/s for 0.32 s; the camera moves to the left.
  const double angle = std::acos(std::clamp(
      turned.direction.head<2>().normalized().dot(before.direction.head<2>().normalized()), -1.0,
      1.0));
  EXPECT_NEAR(angle, 0.67, 0.05);
  EXPECT_GT(turned.direction.dot(right), 0.1);
  // Tilted towards the user: the camera rises.
  daemon.hold({0, 0, 0}, {350, 0, 0}, 10);
  EXPECT_LT(camera().direction.z(), turned.direction.z() - 0.05);
  // Pushed to the right and up: so does the body.
  const QPoint place = pixelOf({0, 0, 0});
  daemon.hold({350, 0, 0}, {0, 0, 0}, 10);
  const QPoint moved = pixelOf({0, 0, 0});
  EXPECT_GT(moved.x(), place.x() + 20);
  EXPECT_NEAR(moved.y(), place.y(), 2);
  daemon.hold({0, 350, 0}, {0, 0, 0}, 10);
  EXPECT_LT(pixelOf({0, 0, 0}).y(), moved.y() - 20);
  // Pushed away: it becomes smaller.
  const double zoom = camera().zoom;
  daemon.hold({0, 0, 350}, {0, 0, 0}, 10);
  EXPECT_LT(camera().zoom, 0.9 * zoom);
  keepPicture("mouse-3d-moved");
  // A cap that is only touched moves nothing.
  const view::CameraView still = camera();
  daemon.hold({6, -7, 5}, {7, 8, -6}, 10);
  EXPECT_EQ(camera().direction, still.direction);
  EXPECT_NEAR(camera().zoom, still.zoom, 1e-9);
  // The first button shows all.
  daemon.click(0);
  EXPECT_NEAR(camera().zoom, 1, 0.2);
  EXPECT_NEAR(pixelOf({0, 0, 0}).x(), view().width() / 2, 0.2 * view().width());
}

TEST_F(Mouse3dInWindow, ThePinFollowsTheCapInSimulate) {
  Daemon daemon(path());
  open(daemon);
  action("Simulate")->trigger();
  Simulation& simulation = window_->simulation();
  ASSERT_TRUE(QTest::qWaitFor([&] { return simulation.drawn() != nullptr; }, 20000));
  const auto id = simulation.begin({bem::ContactTool::Kind::kGrab, 8}, {0, 0, 25}, {0, 0, 0});
  ASSERT_TRUE(id);
  ASSERT_TRUE(QTest::qWaitFor([&] { return simulation.snapshot().contactCount == 1; }, 20000));
  const view::CameraView before = camera();
  daemon.hold({350, 0, 0}, {0, 0, 0}, 20);
  const Vector3d right = before.direction.cross(before.up).normalized();
  // 1.5 radii per second for 0.32 s
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        const auto* contact = simulation.snapshot().find(*id);
        return contact && (contact->value - 3.84 * right).norm() < 0.02;
      },
      5000))
      << simulation.snapshot().find(*id)->value.transpose();
  EXPECT_EQ(camera().direction, before.direction);
  // On a busy machine the columns of the place come later than the motion.
  EXPECT_TRUE(
      QTest::qWaitFor([&] { return simulation.snapshot().find(*id)->force.norm() > 0.1; }, 20000));
  keepPicture("mouse-3d-pin");
  // Turning the cap still turns the view; the second button releases all.
  daemon.hold({0, 0, 0}, {0, 350, 0}, 5);
  EXPECT_GT((camera().direction - before.direction).norm(), 0.05);
  daemon.click(1);
  EXPECT_TRUE(QTest::qWaitFor([&] { return simulation.snapshot().contactCount == 0; }, 5000));
}

TEST_F(Mouse3dInWindow, IsFoundAgainAndCanBeSwitchedOff) {
  Daemon daemon(path());
  open(daemon);
  daemon.hangUp();  // the daemon is started again
  ASSERT_TRUE(daemon.accept());
  const view::CameraView before = camera();
  daemon.hold({0, 0, 0}, {0, 350, 0}, 10);
  EXPECT_GT((camera().direction - before.direction).norm(), 0.1);
  action("3-D mouse")->trigger();
  EXPECT_TRUE(QTest::qWaitFor([&] { return daemon.isLeft(); }, 5000));
  daemon.hangUp();
  restart();  // the choice is kept
  EXPECT_FALSE(action("3-D mouse")->isChecked());
  QTest::qWait(100);
  action("3-D mouse")->trigger();
  EXPECT_TRUE(daemon.accept());
}

TEST_F(Mouse3dInWindow, WithoutADaemonNothingIsSaid) {
  restart();
  ASSERT_TRUE(window_->openFile(kSphere));
  waitForModel();
  EXPECT_TRUE(action("3-D mouse")->isChecked());
  EXPECT_TRUE(window_->messages().messages().isEmpty());
}

}  // namespace
}  // namespace palpa::gui
