#include <QAction>
#include <QSignalSpy>
#include <algorithm>

#include "app/core/design/carried_stiffness.h"
#include "app/core/design/stiffness_gradient.h"
#include "app/core/design/surface_gradient.h"
#include "app/gui/document/gradient_words.h"
#include "app/view/scene/gradient_arrows.h"
#include "modeling/project/project_file.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

using Eigen::Vector3d;

class StiffnessGradients : public WindowTest {
 protected:
  static inline const QString kBox = PALPA_PROJECTS "/box.json";

  StiffnessGradients() { QApplication::setActiveWindow(window_.get()); }

  Simulation& simulation() { return window_->simulation(); }
  TouchGradient& gradient() { return editor().gradient(); }
  const view::GradientDrawing& drawing() { return window_->gradientView().drawing(); }
  QString legend() {
    QStringList lines;
    for (const std::string& line : drawing().legend) lines << QString::fromStdString(line);
    return lines.join('\n');
  }
  /// The entry of *Colour by* with this name.
  QAction* colours(const QString& name) { return action(name); }

  void enter(const QString& file) {
    ASSERT_TRUE(window_->openFile(file));
    waitForModel();
    action("Simulate")->trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return simulation().drawn() != nullptr; }, 20000));
    QTest::qWait(50);
  }
  void slowly(QPoint from, QPoint to, Qt::KeyboardModifiers modifiers = {}) {
    for (int i = 1; i <= 8; ++i) {
      moveTo(from + (to - from) * i / 8, Qt::LeftButton, modifiers);
      QTest::qWait(15);
    }
  }
  bool waitForGradient() {
    return QTest::qWaitFor(
        [&] { return gradient().known() && !gradient().isOutdated() && !gradient().isComputing(); },
        30000);
  }
  QPoint onTop() { return pixelOf({-8, 0, 20}); }
  /// Grabs the top of the box, pulls, and leaves a pin.
  void pinTop() {
    const QPoint at = onTop();
    QTest::mousePress(&view(), Qt::LeftButton, {}, at);
    slowly(at, at + QPoint(20, -40));
    QTest::mouseRelease(&view(), Qt::LeftButton, Qt::ShiftModifier, at + QPoint(20, -40));
  }
  /// In Model mode with the arrows of a touch on the box.
  void modelWithArrows() {
    enter(kBox);
    action("Gradient arrows")->trigger();
    pinTop();
    ASSERT_TRUE(waitForGradient());
    const double live = simulation().snapshot().touched().front().stiffness;
    action("Model")->trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return gradient().stiffness().has_value(); }, 30000));
    // At rest the stiffness is the one of the touch loop.
    EXPECT_NEAR(gradient().stiffness()->value, live, 1e-3 * live);
  }
  /// The pickable control point with the largest arrow.
  int pointWithArrow() {
    const Eigen::Matrix3Xd& values = gradient().known()->gradient;
    std::vector<int> points = view::pointsWithArrows(values);
    std::sort(points.begin(), points.end(), [&](int a, int b) {
      return values.col(a).squaredNorm() > values.col(b).squaredNorm();
    });
    for (const int point : points) {
      const Eigen::Vector2d pixel = view().viewport().toPixel(
          editor().solid()->controlPoints()[static_cast<std::size_t>(point)]);
      if (view().viewport().controlPointAt(pixel) == point) return point;
    }
    ADD_FAILURE() << "no point with an arrow can be picked";
    return 0;
  }
  const Vector3d& place(int point) {
    return editor().solid()->controlPoints()[static_cast<std::size_t>(point)];
  }
  void keys(const QString& text) {
    for (const QChar& letter : text) QTest::keyClick(&view(), letter.toLatin1());
  }
};

TEST_F(StiffnessGradients, ArrowsFollowTheTouchAndHaveALegend) {
  enter(kBox);
  EXPECT_TRUE(drawing().legend.empty());
  action("Gradient arrows")->trigger();
  EXPECT_TRUE(legend().contains("touch the body")) << legend().toStdString();
  const QPoint at = onTop();
  QTest::mousePress(&view(), Qt::LeftButton, {}, at);
  slowly(at, at + QPoint(0, -60));
  ASSERT_TRUE(waitForGradient());
  QTest::qWait(100);
  // The gradient of the rule for this touch, exactly.
  const auto known = *gradient().known();
  const app::StiffnessGradients expected(editor().project(), *known.model);
  const Eigen::Matrix3Xd values = expected.of(known.rule).gradient;
  EXPECT_LT((known.gradient - values).norm(), 1e-6 * values.norm());
  const auto points = view::pointsWithArrows(values);
  ASSERT_EQ(drawing().arrows.arrows.size(), points.size());
  EXPECT_LT(points.size(), static_cast<std::size_t>(values.cols())) << "small arrows are hidden";
  EXPECT_TRUE(legend().contains("Grab 1")) << legend().toStdString();
  EXPECT_TRUE(legend().contains("N/mm per mm")) << legend().toStdString();
  EXPECT_EQ(std::count_if(drawing().arrows.arrows.begin(), drawing().arrows.arrows.end(),
                          [](const auto& arrow) { return !arrow.label.empty(); }),
            static_cast<int>(view::kGradientLabels));
  keepPicture("gradient-arrows");
  // Farther in the same direction: the gradient stays, the arrows move with the body.
  const auto before = drawing().arrows.arrows;
  QSignalSpy framed(&simulation(), &Simulation::framed);
  slowly(at + QPoint(0, -60), at + QPoint(0, -100));
  ASSERT_TRUE(QTest::qWaitFor([&] { return framed.count() > 3; }, 5000));
  QTest::qWait(100);
  EXPECT_FALSE(gradient().isComputing());
  EXPECT_EQ(gradient().known()->gradient, known.gradient);
  double moved = 0;
  for (std::size_t k = 0; k < before.size(); ++k)
    moved = std::max(moved, (drawing().arrows.arrows[k].at - before[k].at).norm());
  EXPECT_GT(moved, 0.2);
  // Another direction: the former gradient is marked until the new one is known.
  bool wasOutdated = false;
  QObject::connect(&gradient(), &TouchGradient::changed, &view(), [&] {
    if (gradient().isOutdated() && drawing().isOutdated) wasOutdated = true;
  });
  slowly(at + QPoint(0, -100), at + QPoint(120, -40));
  ASSERT_TRUE(QTest::qWaitFor([&] { return wasOutdated; }, 10000));
  ASSERT_TRUE(waitForGradient());
  EXPECT_GT((gradient().known()->gradient - known.gradient).norm(), 0.05 * known.gradient.norm());
  // Escape ends the touch; its gradient stays.
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, at + QPoint(120, -40));
  QTest::keyClick(&view(), Qt::Key_Escape);
  ASSERT_TRUE(QTest::qWaitFor([&] { return simulation().snapshot().contactCount == 0; }, 5000));
  QTest::qWait(100);
  EXPECT_FALSE(drawing().arrows.arrows.empty());
  action("Gradient arrows")->trigger();
  EXPECT_TRUE(drawing().arrows.arrows.empty());
  EXPECT_TRUE(drawing().legend.empty());
}

TEST_F(StiffnessGradients, ColoursShowWhereMaterialMakesItStiffer) {
  enter(kBox);
  colours("Stiffness gradient")->trigger();
  QTest::qWait(100);
  for (const double value : simulation().values()) ASSERT_TRUE(std::isnan(value));
  pinTop();
  ASSERT_TRUE(waitForGradient());
  QTest::qWait(200);
  EXPECT_EQ(simulation().values().size(), simulation().drawn()->mesh().positions.size());
  EXPECT_EQ(simulation().range()[0], -simulation().range()[1]);
  double low = 0, high = 0;
  for (const double value : simulation().values()) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  EXPECT_GT(high, 0);
  EXPECT_LT(low, 0);
  EXPECT_TRUE(simulation().gradientName().contains("Grab 1"));
  EXPECT_TRUE(drawing().arrows.arrows.empty());  // only the colours were chosen
  keepPicture("gradient-colours");
  colours("Displacement |u|")->trigger();
  QTest::qWait(100);
  EXPECT_GE(simulation().range()[0], 0);
}

TEST_F(StiffnessGradients, APointIsDraggedAlongItsArrowWithTheStiffnessShown) {
  modelWithArrows();
  const int point = pointWithArrow();
  const double stiffness = gradient().stiffness()->value;
  const Vector3d from = place(point);
  const Vector3d along = gradient().known()->gradient.col(point);
  const std::string text0 = text();
  EXPECT_FALSE(gradient().stiffness()->isPredicted);
  // By the handle of the gizmo.
  QTest::mouseClick(&view(), Qt::LeftButton, {}, pixelOf(from));
  QTest::qWait(50);
  ASSERT_EQ(editor().selection(), Selection::ofPoints({point}));
  // G, then K: along the gradient.
  moveTo(pixelOf(from));
  keys("gk2");
  const double predicted = stiffness + 2 * along.norm();
  EXPECT_LT((place(point) - from - 2 * along.normalized()).norm(), 1e-9);
  ASSERT_TRUE(gradient().stiffness());
  ASSERT_TRUE(gradient().stiffness()->isPredicted);
  EXPECT_NEAR(gradient().stiffness()->value, predicted, 1e-9 * predicted);
  EXPECT_TRUE(gradient().isOutdated());
  EXPECT_TRUE(drawing().isOutdated);
  keepPicture("gradient-drag");
  // The rebuild replaces the prediction while the motion still runs.
  ASSERT_TRUE(QTest::qWaitFor([&] { return !gradient().stiffness()->isPredicted; }, 30000));
  const double rebuilt = gradient().stiffness()->value;
  EXPECT_GT(rebuilt, stiffness);
  EXPECT_NEAR(rebuilt, predicted, 0.35 * (predicted - stiffness));
  keepPicture("gradient-drag-rebuilt");
  QTest::keyClick(&view(), Qt::Key_Return);
  waitForModel();
  ASSERT_TRUE(waitForGradient());
  EXPECT_FALSE(gradient().stiffness()->isPredicted);
  EXPECT_NEAR(gradient().stiffness()->value, gradient().known()->stiffness, 1e-9);
  EXPECT_GT(gradient().stiffness()->value, stiffness);
  // One step of undo, after which the stiffness is the former one.
  editor().undo();
  EXPECT_EQ(text(), text0);
  EXPECT_FALSE(editor().session().document().canUndo());
  waitForModel();
  ASSERT_TRUE(waitForGradient());
  EXPECT_NEAR(gradient().stiffness()->value, stiffness, 2e-3 * stiffness);
}

TEST_F(StiffnessGradients, TheHandleOfTheGizmoFollowsTheArrow) {
  modelWithArrows();
  const int point = pointWithArrow();
  const Vector3d from = place(point);
  QTest::mouseClick(&view(), Qt::LeftButton, {}, pixelOf(from));
  QTest::qWait(100);
  const std::string text0 = text();
  // Find the handle: somewhere within 100 pixels around the point.
  std::optional<QPoint> handle;
  for (int y = -100; y <= 100 && !handle; y += 4)
    for (int x = -100; x <= 100 && !handle; x += 4) {
      const QPoint at = pixelOf(from) + QPoint(x, y);
      if (view().viewport().gizmoAt({at.x(), at.y()}) == view::GizmoAxis::kGradient) handle = at;
    }
  ASSERT_TRUE(handle) << "the gizmo has no handle along the gradient";
  const Vector3d along = gradient().known()->gradient.col(point).normalized();
  const Eigen::Vector2d step =
      (view().viewport().toPixel(from + along) - view().viewport().toPixel(from)).normalized() * 40;
  drag(*handle, *handle + QPoint(static_cast<int>(step.x()), static_cast<int>(step.y())));
  const Vector3d moved = place(point) - from;
  EXPECT_GT(moved.dot(along), 0.2);
  EXPECT_LT(moved.cross(along).norm(), 1e-6 * moved.norm());
  editor().undo();
  EXPECT_EQ(text(), text0);
  // Escape in the middle of it restores.
  keys("gk3");
  EXPECT_NE(text(), text0);
  QTest::keyClick(&view(), Qt::Key_Escape);
  EXPECT_EQ(text(), text0);
  EXPECT_FALSE(editor().session().document().canUndo());
}

TEST_F(StiffnessGradients, EveryKindOfTouchHasTheStiffnessOfTheTouchLoop) {
  enter(kBox);
  action("Gradient arrows")->trigger();
  for (const char* tool : {"Ball", "Push", "Force"}) {
    action(tool)->trigger();
    const QPoint at = onTop();
    QTest::mousePress(&view(), Qt::LeftButton, {}, at);
    for (int i = 0; i < 6; ++i) {
      QWheelEvent event(at, view().mapToGlobal(at), {}, {0, 120}, Qt::LeftButton, {},
                        Qt::NoScrollPhase, false);
      QApplication::sendEvent(&view(), &event);
      QTest::qWait(30);
    }
    const auto isExact = [&] {
      const auto touched = simulation().snapshot().touched();
      return !touched.empty() && gradient().known() && !gradient().isOutdated() &&
             gradient().name().startsWith(tool) &&
             std::abs(gradient().known()->stiffness / touched.front().stiffness - 1) < 1e-3;
    };
    EXPECT_TRUE(QTest::qWaitFor(isExact, 30000)) << tool;
    EXPECT_FALSE(drawing().arrows.arrows.empty()) << tool;
    QTest::mouseRelease(&view(), Qt::LeftButton, {}, at);
    EXPECT_TRUE(QTest::qWaitFor([&] { return simulation().snapshot().contactCount == 0; }, 5000));
  }
}

TEST_F(StiffnessGradients, AnEditDuringTheTouchGetsItsOwnGradient) {
  enter(kBox);
  action("Gradient arrows")->trigger();
  pinTop();
  ASSERT_TRUE(waitForGradient());
  const double before = gradient().known()->stiffness;
  modeling::Material stiffer = editor().project().material;
  stiffer.youngsModulus *= 2;
  ASSERT_TRUE(editor().perform(modeling::SetMaterial{stiffer}));
  EXPECT_TRUE(gradient().isOutdated());
  ASSERT_TRUE(waitForGradient());
  // The gradient may lag behind the direction of the pull by the limits of isSameTouch().
  EXPECT_NEAR(gradient().known()->stiffness, 2 * before, 0.06 * before);
  // Another one in the middle of a computation.
  stiffer.youngsModulus *= 2;
  ASSERT_TRUE(editor().perform(modeling::SetMaterial{stiffer}));
  ASSERT_TRUE(QTest::qWaitFor([&] { return gradient().isComputing(); }, 20000));
  stiffer.youngsModulus /= 4;
  ASSERT_TRUE(editor().perform(modeling::SetMaterial{stiffer}));
  waitForModel();
  ASSERT_TRUE(waitForGradient());
  EXPECT_NEAR(gradient().known()->stiffness, before, 0.03 * before);
}

TEST_F(StiffnessGradients, AnotherProjectForgetsTheTouch) {
  enter(kBox);
  action("Gradient arrows")->trigger();
  const QPoint at = onTop();
  QTest::mousePress(&view(), Qt::LeftButton, {}, at);
  slowly(at, at + QPoint(20, -40));
  ASSERT_TRUE(QTest::qWaitFor([&] { return gradient().isComputing(); }, 20000));
  ASSERT_TRUE(window_->openFile(kSphere));  // in the middle of it
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, at + QPoint(20, -40));
  QTest::qWait(1500);
  EXPECT_FALSE(gradient().known());
  EXPECT_FALSE(gradient().hasTouch());
  EXPECT_TRUE(drawing().arrows.arrows.empty());
  EXPECT_TRUE(legend().contains("F5")) << legend().toStdString();
}

TEST_F(StiffnessGradients, ClosingTheWindowEndsAComputation) {
  enter(kSphere);
  action("Gradient arrows")->trigger();
  const QPoint at = pixelOf({15, -15, 13});
  QTest::mousePress(&view(), Qt::LeftButton, {}, at);
  slowly(at, at + QPoint(60, -30));
  ASSERT_TRUE(QTest::qWaitFor([&] { return gradient().isComputing(); }, 20000));
  window_.reset();
}

TEST_F(StiffnessGradients, RefusedBodiesAreGreyedOutWithTheReason) {
  ASSERT_TRUE(window_->openFile(kBox));
  EXPECT_TRUE(action("Gradient arrows")->isEnabled());
  modeling::Support rolling = editor().project().supports.front();
  rolling.kind = modeling::Support::Kind::kRoller;
  ASSERT_TRUE(editor().perform(modeling::SetSupport{rolling.name, rolling}));
  for (const char* name : {"Gradient arrows", "Stiffness gradient"}) {
    EXPECT_FALSE(action(name)->isEnabled()) << name;
    EXPECT_TRUE(action(name)->toolTip().contains("rollers"))
        << action(name)->toolTip().toStdString();
  }
  editor().undo();
  EXPECT_TRUE(action("Gradient arrows")->isEnabled());
  // Shown arrows can still be hidden; their legend has the reason.
  action("Gradient arrows")->trigger();
  ASSERT_TRUE(editor().perform(modeling::SetSupport{rolling.name, rolling}));
  EXPECT_TRUE(action("Gradient arrows")->isEnabled());
  EXPECT_TRUE(legend().contains("rollers")) << legend().toStdString();
}

}  // namespace
}  // namespace palpa::gui
