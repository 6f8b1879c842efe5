#include "bench/window_driver.h"

#include <QApplication>
#include <QElapsedTimer>
#include <QEventLoop>
#include <QMouseEvent>
#include <cmath>
#include <ctime>
#include <stdexcept>

namespace palpa::bench {
namespace {

constexpr int kMotionInterval = 16;    // ms, as most mice and screens
constexpr double kRadius = 30;         // pixels around the place where a point was
constexpr double kTurnsPerSecond = 1;  // a hand that hurries

/// Of all threads of the process since its start.
double processorMilliseconds() {
  timespec used{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
  return 1e3 * static_cast<double>(used.tv_sec) + 1e-6 * static_cast<double>(used.tv_nsec);
}

}  // namespace

bool runUntil(const std::function<bool()>& holds, double seconds) {
  QElapsedTimer clock;
  clock.start();
  while (!holds()) {
    if (static_cast<double>(clock.elapsed()) > seconds * 1e3) return false;
    QEventLoop loop;
    QTimer::singleShot(2, &loop, &QEventLoop::quit);
    loop.exec();
  }
  return true;
}

void runFor(double seconds) {
  runUntil([] { return false; }, seconds);
}

WindowDriver::WindowDriver() : window_(std::make_unique<gui::MainWindow>()) {
  bool isPainted = false;
  QObject context;
  QObject::connect(&window_->viewport(), &gui::ViewportWidget::framePainted, &context,
                   [&] { isPainted = true; });
  window_->show();
  if (!runUntil([&] { return isPainted; }, 60)) throw std::runtime_error("nothing was painted");
}

double WindowDriver::waitForModel() {
  using State = app::RebuildStatus::State;
  QElapsedTimer clock;
  clock.start();
  const auto isBuilding = [&] { return editor().rebuildStatus().state == State::kBuilding; };
  if (!runUntil([&] { return !isBuilding(); }, 600))
    throw std::runtime_error("the model is not there after ten minutes");
  if (editor().rebuildStatus().state != State::kUpToDate)
    throw std::runtime_error(editor().rebuildStatus().error);
  return static_cast<double>(clock.nsecsElapsed()) * 1e-9;
}

QPoint WindowDriver::visiblePoint() {
  gui::ViewportWidget& view = window_->viewport();
  const QRect inner = view.rect().adjusted(60, 60, -60, -60);
  const auto& points = editor().solid()->controlPoints();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d device = view.viewport().toPixel(points[i]);
    const QPoint at(static_cast<int>(std::lround(device.x() / view.devicePixelRatioF())),
                    static_cast<int>(std::lround(device.y() / view.devicePixelRatioF())));
    if (inner.contains(at) && view.viewport().controlPointAt(device) == static_cast<int>(i))
      return at;
  }
  throw std::runtime_error("no control point can be seen");
}

void WindowDriver::send(QEvent::Type type, QPoint at, Qt::MouseButton button,
                        Qt::MouseButtons buttons) {
  gui::ViewportWidget& view = window_->viewport();
  QMouseEvent event(type, at, view.mapToGlobal(at), button, buttons, Qt::NoModifier);
  QApplication::sendEvent(&view, &event);
}

WindowDriver::Drag WindowDriver::drag(double seconds) {
  return moveAround(visiblePoint(), seconds);
}

WindowDriver::Drag WindowDriver::touch(double seconds) {
  gui::Simulation& simulation = window_->simulation();
  simulation.setActive(true);
  if (!runUntil([&] { return simulation.drawn() != nullptr; }, 60))
    throw std::runtime_error("Simulate mode does not begin");
  const gui::ViewportWidget& view = window_->viewport();
  const QPoint middle = view.rect().center();
  // A body with a hole has none in the middle.
  for (int x = 0; x < view.width() / 2; x += 20)
    if (window_->viewport().viewport().surfaceAt(Eigen::Vector2d(middle.x() + x, middle.y()) *
                                                 view.devicePixelRatioF()))
      return moveAround(middle + QPoint(x, 0), seconds);
  throw std::runtime_error("no surface can be seen");
}

WindowDriver::Drag WindowDriver::orbit(double seconds) {
  return moveAround(window_->viewport().rect().center(), seconds, Qt::MiddleButton);
}

void WindowDriver::resize(const QSize& size) {
  bool isPainted = false;
  QObject context;
  window_->resize(size);
  runFor(0.3);
  QObject::connect(&window_->viewport(), &gui::ViewportWidget::framePainted, &context,
                   [&] { isPainted = true; });
  window_->viewport().update();
  if (!runUntil([&] { return isPainted; }, 60)) throw std::runtime_error("nothing was painted");
}

void WindowDriver::rest() {
  runFor(0.5);
}

WindowDriver::Drag WindowDriver::moveAround(QPoint start, double seconds, Qt::MouseButton button) {
  Drag result;
  int frames = 0;
  double processor = 0;                  // ms
  double paintTime = 0, motionTime = 0;  // ms
  QElapsedTimer clock;
  double first = 0, last = 0;  // s, of the motions
  QObject context;
  QObject::connect(&window_->viewport(), &gui::ViewportWidget::framePainted, &context, [&] {
    ++frames;
    paintTime += window_->viewport().lastFrameMilliseconds();
  });
  QTimer mouse;
  mouse.setTimerType(Qt::PreciseTimer);
  QObject::connect(&mouse, &QTimer::timeout, &context, [&] {
    last = static_cast<double>(clock.nsecsElapsed()) * 1e-9;
    if (result.motions++ == 0) {
      first = last;
      frames = 0;
      paintTime = motionTime = 0;
      processor = processorMilliseconds();
    }
    const double angle = 2 * M_PI * kTurnsPerSecond * last;
    const QPoint offset(static_cast<int>(std::lround(kRadius * std::sin(angle))),
                        static_cast<int>(std::lround(kRadius * (std::cos(angle) - 1))));
    QElapsedTimer handling;
    handling.start();
    send(QEvent::MouseMove, start + offset, Qt::NoButton, button);
    motionTime += static_cast<double>(handling.nsecsElapsed()) * 1e-6;
  });
  send(QEvent::MouseButtonPress, start, button, button);
  clock.start();
  mouse.start(kMotionInterval);
  runFor(seconds);
  mouse.stop();
  result.framesPerSecond = frames / std::max(last - first, 1e-3);
  result.motionMilliseconds = motionTime / std::max(result.motions, 1);
  result.paintMilliseconds = paintTime / std::max(frames, 1);
  result.processorMilliseconds = (processorMilliseconds() - processor) / std::max(frames, 1);
  send(QEvent::MouseMove, start + QPoint(7, 4), Qt::NoButton, button);
  send(QEvent::MouseButtonRelease, start + QPoint(7, 4), button, Qt::NoButton);
  return result;
}

}  // namespace palpa::bench
