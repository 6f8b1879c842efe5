#pragma once

#include <QPoint>
#include <functional>
#include <memory>

#include "app/gui/window/main_window.h"

namespace palpa::bench {

/// Runs the event loop until the condition holds; false when `seconds` have gone by before.
bool runUntil(const std::function<bool()>& holds, double seconds);
void runFor(double seconds);

/// A person at the window: sends it real mouse events and waits for what it does.
class WindowDriver {
 public:
  /// Shows a new window and waits for its first picture.
  WindowDriver();

  gui::MainWindow& window() { return *window_; }
  gui::Editor& editor() { return window_->editor(); }

  /// Waits until the model belongs to the newest edit; the seconds it took. std::runtime_error when
  /// it cannot be built.
  double waitForModel();

  struct Drag {
    int motions = 0;
    double framesPerSecond = 0;     ///< of all frames between the first motion and the last
    double motionMilliseconds = 0;  ///< to handle one, on average
    double paintMilliseconds =
        0;  ///< to draw a frame, on average, without the window's other parts
  };
  /// Drags a visible control point around for `seconds`, 60 motions a second, and lets go near
  /// where it was. std::runtime_error when no control point can be seen.
  Drag drag(double seconds);
  /// The same in Simulate mode: grabs the surface in the middle of the view and pulls it around.
  /// std::runtime_error when it is not there.
  Drag touch(double seconds);

 private:
  Drag moveAround(QPoint start, double seconds);
  QPoint visiblePoint();
  void send(QEvent::Type type, QPoint at, Qt::MouseButton button, Qt::MouseButtons buttons);

  std::unique_ptr<gui::MainWindow> window_;
};

}  // namespace palpa::bench
