#include <QApplication>
#include <QComboBox>
#include <QDialog>
#include <QDir>
#include <QPushButton>
#include <QTemporaryDir>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "app/core/session/new_project.h"
#include "app/gui/base/appearance.h"
#include "app/gui/base/application.h"
#include "app/gui/dialogs/primitive_kinds.h"
#include "app/gui/document/touch_gradient.h"
#include "modeling/shapes/make_primitive.h"
#include "tests/gui/films.h"
#include "tests/gui/photographer.h"

// Makes the pictures of the user guide; drives the window by mouse and key events and photographs
// it. See scripts/make-screenshots and scripts/make-animations.
//   palpa_screenshots FOLDER             the pictures
//   palpa_screenshots --films FOLDER     numbered pictures of bodies being touched, a folder each
//   palpa_screenshots --plot CSV PNG     forces that palpa-touch-bench --csv wrote, as curves
namespace palpa::gui {
namespace {

/// A new project with the second extruded example, a bean.
void startWithProfile(Photographer& p) {
  for (const PrimitiveKind& kind : primitiveKinds()) {
    modeling::Primitive primitive = kind.primitive;
    if (!std::holds_alternative<modeling::ExtrudeShape>(primitive.shape)) continue;
    primitive.shape = kind.profiles.at(1).shape;
    modeling::Project project = app::makeProject(modeling::makePrimitive(primitive), "bean");
    project.primitive = primitive;
    p.editor().start(std::move(project));
  }
}

/// A thicker gripper finger beside the former one, under the same touch.
void compareFingers(Photographer& p) {
  p.open("gripper-finger");
  p.editor().perform(modeling::TransformSolid{modeling::Scaling{{1, 1, 1.25}, {0, 0, 0}}});
  p.waitForBuild();
  p.window().comparisonActions().compareWithStateBefore(1);
  const auto isCompared = [&p] {
    const auto result = p.window().comparison().result();
    return result && result->comparison && !p.window().comparison().isComputing() &&
           result->comparison->states[1].state.errorEstimate;
  };
  (void)QTest::qWaitFor(isCompared, 60000);
  p.window().viewport().viewport().fit();
  p.grab(p.middle() + QPoint(20, -40), QPoint(60, 50));
  (void)QTest::qWaitFor(isCompared, 60000);
  p.shoot("compare");
  p.letGo();
}

/// Dimensions of a cylinder; the radius of its rim follows the pointer.
void measureCylinder(Photographer& p) {
  p.open("cylinder");
  p.key(Qt::Key_M);
  const double radius = 20, height = 60;
  const auto at = [&](double degrees, double z, double r) {
    const double angle = degrees * std::numbers::pi / 180;
    const Eigen::Vector2d pixel =
        p.window().viewport().viewport().toPixel({r * std::cos(angle), r * std::sin(angle), z});
    return QPoint(static_cast<int>(std::lround(pixel.x())),
                  static_cast<int>(std::lround(pixel.y())));
  };
  const auto take = [&](QPoint pixel) {
    p.hover(pixel);
    p.click(pixel);
  };
  take(at(-110, height, radius));  // distance: from rim to rim
  take(at(-110, 0, radius));
  p.key(Qt::Key_Tab);
  p.key(Qt::Key_Tab);  // angle
  take(at(-40, height, 0.6 * radius));
  take(at(-40, 0.75 * height, radius));
  p.key(Qt::Key_Tab);  // wall thickness
  take(at(-60, 0.3 * height, radius));
  p.key(Qt::Key_Tab);  // radius
  p.hover(at(10, height, radius));
  p.shoot("measure");
  p.key(Qt::Key_S);
}

/// The box is pulled: gradient of its stiffness; then a point is dragged along its arrow.
void pullBox(Photographer& p) {
  p.open("box");
  p.action("Gradient arrows")->trigger();
  p.action("Stiffness gradient")->trigger();
  TouchGradient& gradient = p.editor().gradient();
  const auto isKnown = [&] {
    return gradient.known() && !gradient.isOutdated() && !gradient.isUpdating();
  };
  p.grab(p.middle() + QPoint(60, -110), QPoint(50, -60));
  (void)QTest::qWaitFor(isKnown, 60000);
  p.shoot("simulate-gradient");
  p.action("Displacement |u|")->trigger();
  p.letGo();
  (void)QTest::qWaitFor([&] { return gradient.stiffness().has_value(); }, 60000);
  const QPoint point = p.pointNear(p.middle() + QPoint(-8, 61));
  p.click(point);
  p.key(Qt::Key_G);
  p.key(Qt::Key_K);
  p.key(Qt::Key_3);
  (void)QTest::qWaitFor(isKnown, 60000);
  p.shoot("drag-gradient");
  p.key(Qt::Key_Escape);
  p.action("Gradient arrows")->trigger();
}

/// The pad with two stiffnesses: the found shape as a ghost, with its numbers.
void findPad(Photographer& p) {
  p.open("design/two-stiffness-pad");
  p.action("Reset layout")->trigger();
  p.action("Find a shape")->trigger();
  QTest::qWait(500);
  p.find<QPushButton>("findShape")->click();
  const ShapeFinder& finder = p.window().shapeFinder();
  (void)QTest::qWaitFor([&] { return !finder.isSearching(); }, 120000);
  p.shoot("find-shape");
  p.find<QPushButton>("searchDiscard")->click();
  p.action("Reset layout")->trigger();
}

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
  p.open("sphere");
  p.key(Qt::Key_K);
  p.hover(p.middle() + QPoint(-40, 30));
  p.shoot("insert-knot");
  p.key(Qt::Key_P);
  if (auto* way = p.find<QComboBox>("paintWay")) QTest::keyClick(way, Qt::Key_Down);
  p.drag(p.middle() - QPoint(140, 70), p.middle() + QPoint(110, -60));
  p.shoot("paint-support");
  p.editor().undo();
  p.open("gripper-finger");
  p.action("Gravity")->trigger();
  p.action("Moment")->trigger();
  p.editor().select(Selection::ofPatches({*modeling::findPatch(p.editor().project().body, "top")}));
  p.action("Moment")->trigger();
  p.waitForBuild();
  p.shoot("place-load");
  p.open("sphere");
  p.key(Qt::Key_R);
  p.click(p.pointNear(p.middle()));
  p.shoot("rotate");
  p.key(Qt::Key_S);

  p.open("sphere");
  p.pressWithBall(p.middle() + QPoint(-60, -70));
  p.shoot("simulate-ball");
  p.letGo();
  p.open("gripper-finger");
  p.simulate("Grab");
  p.action("Stiffness")->trigger();
  (void)QTest::qWaitFor([&] { return p.window().simulation().stiffnessReady() >= 1; }, 120000);
  p.window().viewport().viewport().fit();
  p.window().viewport().update();
  p.shoot("simulate-stiffness");
  p.action("Displacement |u|")->trigger();
  p.letGo();
  p.theme(Theme::kDark);
  p.grab(p.middle() + QPoint(40, -60), QPoint(70, 60));
  p.shoot("simulate-grab-dark");
  p.letGo();
  p.theme(Theme::kLight);

  pullBox(p);
  measureCylinder(p);
  compareFingers(p);
  findPad(p);

  // A point is pulled through the opposite side: signs mark the self-intersection.
  p.open("sphere");
  p.moveHighestPoint({0, 0, -130});
  p.find<QPushButton>("rebuildStatus")->click();
  p.shoot("folded");
  p.editor().undo();

  p.shootDialog("welcome", "Welcome");
  p.shootDialog("new-solid", "New");
  startWithProfile(p);
  p.shootDialog("edit-profile", "Edit profile");
  p.shootDialog("material", "Material");
  p.shootDialog("preferences", "Preferences");
  p.action("User guide")->trigger();
  p.shoot("guide", p.find<QDialog>("guide"));
}

}  // namespace
}  // namespace palpa::gui

int main(int argc, char** argv) {
  palpa::gui::Application application(argc, argv);
  const bool films = argc == 3 && std::string(argv[1]) == "--films";
  const bool plot = argc == 4 && std::string(argv[1]) == "--plot";
  if (!(films || plot || argc == 2) || (!plot && !QDir().mkpath(argv[argc - 1]))) {
    std::fprintf(stderr, "usage: palpa_screenshots [--films] FOLDER | --plot CSV PNG\n");
    return 2;
  }
  // Keeps the user's settings and snapshots unchanged.
  const QTemporaryDir own;
  qputenv("XDG_STATE_HOME", own.path().toUtf8());
  qputenv("XDG_CACHE_HOME", own.path().toUtf8());
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, own.path());
  palpa::gui::applyTheme(application, palpa::gui::Theme::kLight);
  if (plot) return palpa::gui::plotSlide(argv[2], argv[3]);
  if (films)
    palpa::gui::film(argv[2]);
  else
    palpa::gui::photograph(argv[1]);
  return 0;
}
