#include <QApplication>
#include <QComboBox>
#include <QDir>
#include <QElapsedTimer>
#include <QMouseEvent>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>
#include <cstdio>
#include <functional>

#include "app/gui/appearance.h"
#include "app/gui/main_window.h"
#include "modeling/shapes/make_primitive.h"

// Makes the pictures of the user guide: `palpa_screenshots FOLDER`. Drives the window as a person
// would and photographs it; see scripts/make-screenshots.
namespace palpa::gui {
namespace {

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
    (void)QTest::qWaitFor(
        [this] {
          return window_.editor().rebuildStatus().state != app::RebuildStatus::State::kBuilding;
        },
        60000);
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

  void simulate(const QString& tool) {
    action("Simulate")->trigger();
    if (!QTest::qWaitFor([this] { return window_.simulation().drawn() != nullptr; }, 60000))
      std::fprintf(stderr, "palpa_screenshots: Simulate mode does not begin\n");
    QTest::qWait(200);
    action(tool)->trigger();
  }
  void pressWithBall(QPoint at) {
    simulate("Ball");
    held_ = at;
    QTest::mousePress(&view(), Qt::LeftButton, {}, at);
    for (int i = 0; i < 10; ++i) {
      QWheelEvent event(at, view().mapToGlobal(at), {}, {0, 120}, Qt::LeftButton, {},
                        Qt::NoScrollPhase, false);
      QApplication::sendEvent(&view(), &event);
      QTest::qWait(50);
    }
    QTest::qWait(2000);
  }
  void grab(QPoint at, QPoint by) {
    simulate("Grab");
    held_ = at + by;
    QTest::mousePress(&view(), Qt::LeftButton, {}, at);
    for (int i = 1; i <= 20; ++i) move(at + by * i / 20, Qt::LeftButton);
    QTest::qWait(2000);
  }
  /// Back to modelling.
  void letGo() {
    QTest::mouseRelease(&view(), Qt::LeftButton, {}, held_);
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
  QPoint held_;  // where a contact is held
};

void photograph(const QString& folder) {
  Photographer photographer(folder);
  Photographer& p = photographer;
  p.size(1280, 800);
  p.open("sphere");
  const QPoint point = p.pointNear(p.middle() + QPoint(150, -180));
  p.drag(point, point + QPoint(70, -50));
  p.shoot("move-point");
  p.editor().undo();

  p.open("gripper-finger");
  p.shoot("gripper");
  p.theme(Theme::kDark);
  p.shoot("gripper-dark");
  p.theme(Theme::kLight);
  p.size(1920, 1080);
  p.open("liver-phantom");
  p.shoot("liver-large");
  p.theme(Theme::kDark);
  p.shoot("liver-large-dark");
  p.theme(Theme::kLight);
  p.size(1280, 800);

  p.open("sphere");
  p.key(Qt::Key_K);
  p.hover(p.middle() + QPoint(-40, 30));
  p.shoot("insert-knot");
  p.key(Qt::Key_P);
  if (auto* way = p.find<QComboBox>("paintWay")) QTest::keyClick(way, Qt::Key_Down);
  p.drag(p.middle() - QPoint(140, 70), p.middle() + QPoint(110, -60));
  p.shoot("paint-support");
  p.editor().undo();
  p.key(Qt::Key_L);
  p.drag(p.middle() + QPoint(20, -40), p.middle() + QPoint(90, -40));
  p.shoot("place-load");
  p.editor().undo();
  p.key(Qt::Key_R);
  p.click(p.pointNear(p.middle()));
  p.shoot("rotate");
  p.key(Qt::Key_S);

  p.open("sphere");
  p.pressWithBall(p.middle() + QPoint(-60, -70));
  p.shoot("simulate-ball");
  p.letGo();
  p.open("gripper-finger");
  p.theme(Theme::kDark);
  p.grab(p.middle() + QPoint(40, -60), QPoint(70, 60));
  p.shoot("simulate-grab-dark");
  p.letGo();
  p.theme(Theme::kLight);

  p.shootDialog("new-solid", "New");
  p.shootDialog("material", "Material");
  p.shootDialog("preferences", "Preferences");
}

}  // namespace
}  // namespace palpa::gui

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  if (argc != 2 || !QDir().mkpath(argv[1])) {
    std::fprintf(stderr, "usage: palpa_screenshots FOLDER\n");
    return 2;
  }
  // Settings and snapshots of the person who runs this stay as they are.
  const QTemporaryDir own;
  qputenv("XDG_STATE_HOME", own.path().toUtf8());
  qputenv("XDG_CACHE_HOME", own.path().toUtf8());
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, own.path());
  palpa::gui::applyTheme(application, palpa::gui::Theme::kLight);
  palpa::gui::photograph(argv[1]);
  return 0;
}
