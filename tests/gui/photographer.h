#pragma once

#include <QApplication>
#include <QDir>
#include <QMouseEvent>
#include <QTest>
#include <QTimer>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/gui/window/main_window.h"
#include "modeling/editing/command.h"

namespace palpa::gui {

/// Drives a window by mouse and key events and photographs it for the user guide.
class Photographer {
 public:
  explicit Photographer(QString folder) : folder_(std::move(folder)) {
    window_.show();
    (void)QTest::qWaitForWindowExposed(&window_);
    QApplication::setActiveWindow(&window_);
  }

  void open(const QString& name) {
    window_.openFile(QStringLiteral(PALPA_PROJECTS "/") + name + ".json");
    window_.viewport().viewport().fit();
    waitForBuild();
  }
  void waitForBuild() {
    (void)QTest::qWaitFor(
        [this] {
          return window_.editor().rebuildStatus().state != app::RebuildStatus::State::kBuilding;
        },
        60000);
  }
  void moveHighestPoint(const Eigen::Vector3d& by) {
    const auto& points = editor().solid()->controlPoints();
    const auto highest = std::max_element(
        points.begin(), points.end(), [](const auto& a, const auto& b) { return a.z() < b.z(); });
    editor().perform(modeling::MovePoints{
        modeling::PointSelection::of({static_cast<int>(highest - points.begin())}),
        modeling::MoveBy{by},
        {}});
    waitForBuild();
  }
  void size(int width, int height) { window_.resize(width, height); }
  void theme(Theme theme) { window_.settings().setTheme(theme); }
  void key(Qt::Key key) { QTest::keyClick(&view(), key); }
  void click(QPoint at) { QTest::mouseClick(&view(), Qt::LeftButton, {}, at); }
  void hover(QPoint at) { move(at, Qt::NoButton); }
  void drag(QPoint from, QPoint to) {
    QTest::mousePress(&view(), Qt::LeftButton, {}, from);
    for (int i = 1; i <= 8; ++i) move(from + (to - from) * i / 8, Qt::LeftButton);
    QTest::mouseRelease(&view(), Qt::LeftButton, {}, to);
  }
  QPoint middle() { return view().rect().center(); }
  /// The visible control point nearest to a place in the view.
  QPoint pointNear(QPoint at) {
    QPoint best = at;
    double nearest = 1e9;
    const modeling::Solid& solid = *editor().solid();
    for (std::size_t i = 0; i < solid.controlPoints().size(); ++i) {
      const Eigen::Vector2d p = view().viewport().toPixel(solid.controlPoints()[i]);
      if (view().viewport().controlPointAt(p) != static_cast<int>(i)) continue;
      const double distance = (p - Eigen::Vector2d(at.x(), at.y())).norm();
      if (distance < nearest) {
        nearest = distance;
        best = {static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y()))};
      }
    }
    return best;
  }
  Editor& editor() { return window_.editor(); }
  QAction* action(const QString& name) { return window_.findChild<QAction*>(name); }
  template <class T>
  T* find(const QString& name) {
    return window_.findChild<T*>(name);
  }

  /// Begins touching with a tool.
  void simulate(const QString& tool) {
    action("Simulate")->trigger();
    if (!QTest::qWaitFor([this] { return window_.simulation().drawn() != nullptr; }, 60000))
      std::fprintf(stderr, "palpa_screenshots: Simulate mode does not begin\n");
    QTest::qWait(200);
    action(tool)->trigger();
  }
  void pressWithBall(QPoint at) {
    simulate("Ball");
    pressedAt_ = at;
    QTest::mousePress(&view(), Qt::LeftButton, {}, at);
    for (int i = 0; i < 10; ++i) {
      wheel(at, 1);
      QTest::qWait(50);
    }
    QTest::qWait(2000);
  }
  void grab(QPoint at, QPoint by) {
    simulate("Grab");
    pressedAt_ = at + by;
    QTest::mousePress(&view(), Qt::LeftButton, {}, at);
    for (int i = 1; i <= 20; ++i) move(at + by * i / 20, Qt::LeftButton);
    QTest::qWait(2000);
  }
  void wheel(QPoint at, int notches) {
    QWheelEvent event(at, view().mapToGlobal(at), {}, {0, 120 * notches}, Qt::LeftButton, {},
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(&view(), &event);
  }
  void press(QPoint at) {
    pressedAt_ = at;
    QTest::mousePress(&view(), Qt::LeftButton, {}, at);
  }
  void dragTo(QPoint at) {
    pressedAt_ = at;
    move(at, Qt::LeftButton);
  }
  void release() { QTest::mouseRelease(&view(), Qt::LeftButton, {}, pressedAt_); }
  MainWindow& window() { return window_; }
  const QString& folder() const { return folder_; }

  /// Back to modelling.
  void letGo() {
    QTest::mouseRelease(&view(), Qt::LeftButton, {}, pressedAt_);
    action("Model")->trigger();
  }

  void shoot(const QString& name, QWidget* of = nullptr) {
    QTest::qWait(500);  // until the fine picture is drawn
    const QString file = folder_ + "/" + name + ".png";
    if (!(of ? of : &window_)->grab().save(file)) {
      std::fprintf(stderr, "palpa_screenshots: cannot write %s\n", qPrintable(file));
      std::exit(1);
    }
    std::printf("%s\n", qPrintable(file));
  }
  /// Photographs the dialog that an action opens, and closes it.
  void shootDialog(const QString& name, const QString& actionName) {
    QTimer::singleShot(600, [this, name] {
      if (QWidget* dialog = QApplication::activeModalWidget()) {
        shoot(name, dialog);
        dialog->close();
      }
    });
    action(actionName)->trigger();
  }

 private:
  ViewportWidget& view() { return window_.viewport(); }
  void move(QPoint at, Qt::MouseButtons buttons) {
    QMouseEvent event(QEvent::MouseMove, at, view().mapToGlobal(at), Qt::NoButton, buttons, {});
    QApplication::sendEvent(&view(), &event);
    QTest::qWait(10);
  }

  QString folder_;
  MainWindow window_;
  QPoint pressedAt_;  // place of the pressed button
};

}  // namespace palpa::gui
