#include "app/gui/view/mouse_3d.h"

#include <sys/socket.h>

#include <algorithm>
#include <cmath>

// Last: it may include X11 with its macros.
#include <spnav.h>

namespace palpa::gui {
namespace {

constexpr int kSearchInterval = 3000;  // ms
/// Deflections in the numbers of spacenavd at sensitivity 1: all of it, and what counts as rest.
constexpr double kFull = 350, kDead = 8;
/// A longer time since the last event means that the cap was at rest.
constexpr double kMaxPeriod = 50;  // ms

/// -1 … 1, a little more for sensitive devices.
double deflection(int value) {
  const double beyond = std::max(0.0, std::abs(static_cast<double>(value)) - kDead);
  return std::copysign(beyond / (kFull - kDead), value);
}

}  // namespace

Mouse3d::Mouse3d(QObject* parent) : QObject(parent) {
  search_.setInterval(kSearchInterval);
  connect(&search_, &QTimer::timeout, this, &Mouse3d::connectToDaemon);
}

Mouse3d::~Mouse3d() {
  search_.stop();
  if (notifier_) spnav_close();
}

void Mouse3d::setActive(bool active) {
  if (active) {
    connectToDaemon();
    search_.start();
  } else {
    search_.stop();
    disconnectFromDaemon();
  }
}

void Mouse3d::connectToDaemon() {
  if (notifier_ || spnav_open() < 0) return;
  spnav_client_name("Palpa");
  notifier_ = std::make_unique<QSocketNotifier>(spnav_fd(), QSocketNotifier::Read);
  connect(notifier_.get(), &QSocketNotifier::activated, this, &Mouse3d::receive);
  Q_EMIT connectedChanged();
}

void Mouse3d::disconnectFromDaemon() {
  if (!notifier_) return;
  spnav_close();
  notifier_->setEnabled(false);
  notifier_.release()->deleteLater();  // this may be its signal
  Q_EMIT connectedChanged();
}

void Mouse3d::receive() {
  Motion sum;
  spnav_event event;
  while (spnav_poll_event(&event) != 0) {
    if (event.type == SPNAV_EVENT_MOTION) {
      const spnav_event_motion& motion = event.motion;
      const double seconds = 1e-3 * std::min(static_cast<double>(motion.period), kMaxPeriod);
      // The z axis of spacenavd points away from the user, as in spnav_posrot_moveobj().
      sum.push += seconds * Eigen::Vector3d(deflection(motion.x), deflection(motion.y),
                                            -deflection(motion.z));
      sum.turn += seconds * Eigen::Vector3d(deflection(motion.rx), deflection(motion.ry),
                                            -deflection(motion.rz));
    } else if (event.type == SPNAV_EVENT_BUTTON && event.button.press != 0) {
      Q_EMIT pressed(event.button.bnum);
    }
  }
  if (!sum.push.isZero(0) || !sum.turn.isZero(0)) Q_EMIT moved(sum);
  char byte = 0;
  if (notifier_ && ::recv(spnav_fd(), &byte, 1, MSG_PEEK | MSG_DONTWAIT) == 0)
    disconnectFromDaemon();
}

}  // namespace palpa::gui
