#pragma once

#include <QPoint>
#include <functional>
#include <memory>

#include "app/gui/window/main_window.h"

namespace palpa::bench {

/// Runs the event loop until the condition holds; false after `seconds`.
bool runUntil(const std::function<bool()>& holds, double seconds);
void runFor(double seconds);

/// Simulated user: sends real mouse events to a window and waits for its response.
class WindowDriver {
 public:
  /// Shows a new window and waits for its first picture.
  WindowDriver();

  gui::MainWindow& window() { return *window_; }
  gui::Editor& editor() { return window_->editor(); }
  /// False for a mesh body.
  bool hasControlPoints() { return editor().solid() != nullptr; }

  /// Waits until the model belongs to the newest edit; returns the seconds. Throws
  /// std::runtime_error if it cannot be built.
  double waitForModel();

  struct Drag {
    int motions = 0;
    double framesPerSecond = 0;     ///< of all frames between the first motion and the last
    double motionMilliseconds = 0;  ///< to handle one motion, on average
    double paintMilliseconds =
        0;  ///< to draw a frame, on average, without the window's other parts
    double processorMilliseconds = 0;  ///< of all threads of the process, per frame
  };
  /// Drags a visible control point around for `seconds`, with 60 motions a second, and releases it
  /// near its start. Throws std::runtime_error if no control point is visible.
  Drag drag(double seconds);
  /// The same in Simulate mode: grabs the surface in the middle of the view and pulls it around.
  /// Throws std::runtime_error if there is no surface.
  Drag touch(double seconds);
  /// Orbits the view with the middle button, in the present mode.
  Drag orbit(double seconds);
  /// Gives the window that size and waits for a picture of it.
  void resize(const QSize& size);
  /// The fine picture after a motion.
  void rest();

 private:
  Drag moveAround(QPoint start, double seconds, Qt::MouseButton button = Qt::LeftButton);
  QPoint visiblePoint();
  void send(QEvent::Type type, QPoint at, Qt::MouseButton button, Qt::MouseButtons buttons);

  std::unique_ptr<gui::MainWindow> window_;
};

}  // namespace palpa::bench
