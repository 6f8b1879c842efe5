#include <QComboBox>
#include <QDialogButtonBox>
#include <QPushButton>
#include <QSignalSpy>
#include <numbers>

#include "app/gui/dialogs/number_dialog.h"
#include "app/gui/document/point_groups.h"
#include "app/gui/tools/motion_geometry.h"
#include "app/gui/tools/point_options.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

class PointTools : public WindowTest {
 protected:
  PointTools() {
    EXPECT_TRUE(window_->openFile(kSphere));
    options_ = window_->findChild<PointOptions*>();
    QApplication::setActiveWindow(window_.get());  // shortcuts need an active window
    view().setFocus();
  }

  const std::vector<Vector3d>& places() { return editor().solid()->controlPoints(); }
  /// Selects a visible point; returns it.
  int selectOne() {
    const int point = visiblePoint();
    editor().select(Selection::ofPoints({point}));
    return point;
  }
  void keys(const QString& text) {
    for (const QChar& letter : text) QTest::keyClick(&view(), letter.toLatin1());
  }
  void key(Qt::Key key, Qt::KeyboardModifiers modifiers = {}) {
    QTest::keyClick(&view(), key, modifiers);
  }
  int steps() {
    int count = 0;
    while (editor().session().document().canUndo()) {
      editor().undo();
      ++count;
    }
    return count;
  }

  PointOptions* options_ = nullptr;
};

TEST(MotionGeometry, AnglesFactorsAndSteps) {
  // A quarter turn from the right to the top of the screen, where pixels are smaller.
  EXPECT_NEAR(degreesAround({100, 100}, {150, 100}, {100, 40}), 90, 1e-12);
  EXPECT_NEAR(degreesAround({100, 100}, {100, 40}, {150, 100}), -90, 1e-12);
  EXPECT_EQ(degreesAround({1, 1}, {1, 1}, {5, 7}), 0);
  EXPECT_NEAR(factorFrom({0, 0}, {100, 0}, {150, 80}), 1.5, 1e-12);
  EXPECT_EQ(factorFrom({0, 0}, {100, 0}, {-50, 0}), 0);
  EXPECT_NEAR(factorFrom({0, 0}, {1, 0}, {51, 9}), 1.5, 1e-12);
  EXPECT_NEAR(snapped(37.6, 15), 45, 1e-12);
  EXPECT_EQ(nearestAxis({0.1, -0.9, 0.3}), -Vector3d::UnitY());
  EXPECT_EQ(nearestAxis({0.1, -0.9, 0.3}, 1), Vector3d::UnitZ());
  EXPECT_NEAR(roundLengthBelow(0.87), 0.5, 1e-12);
  EXPECT_NEAR(roundLengthBelow(1), 1, 1e-12);
  EXPECT_NEAR(roundLengthBelow(49), 20, 1e-12);
}

TEST_F(PointTools, TypedLengthsAreExactAndOneStep) {
  const int point = selectOne();
  const Vector3d from = places()[point];
  const std::string text0 = text();
  keys("gx5");
  keepPicture("typed-length");
  key(Qt::Key_Return);
  EXPECT_EQ(places()[point], from + Vector3d(5, 0, 0));
  // During a motion digits do not trigger shortcuts of the view; afterwards they do.
  keys("gz12.5-");
  key(Qt::Key_Backspace);
  key(Qt::Key_Return);
  EXPECT_EQ(places()[point], from + Vector3d(5, 0, -12));
  EXPECT_EQ(steps(), 2);
  EXPECT_EQ(text(), text0);
}

TEST_F(PointTools, KeysFollowThePointerUntilAClick) {
  const int point = selectOne();
  const Vector3d from = places()[point];
  moveTo(pixelOfPoint(point));
  keys("g");
  moveTo(pixelOfPoint(point) + QPoint(30, -20));
  EXPECT_GT((places()[point] - from).norm(), 0.5);
  keys("y");
  EXPECT_EQ(places()[point].x(), from.x());
  EXPECT_EQ(places()[point].z(), from.z());
  EXPECT_NE(places()[point].y(), from.y());
  keepPicture("held-to-y");
  keys("y");  // free again
  EXPECT_NE(places()[point].z(), from.z());
  QTest::mouseClick(&view(), Qt::LeftButton, {}, pixelOfPoint(point));
  const Vector3d placed = places()[point];
  moveTo(QPoint(200, 200));
  EXPECT_EQ(places()[point], placed);
  EXPECT_EQ(editor().selection(), Selection::ofPoints({point}));
  EXPECT_EQ(steps(), 1);
}

TEST_F(PointTools, EscapeAndTheRightButtonTakeTheMotionBackOnly) {
  const int point = selectOne();
  keys("gx3");
  key(Qt::Key_Return);
  const std::string text1 = text();
  keys("gx7");
  EXPECT_NE(text(), text1);
  key(Qt::Key_Escape);
  EXPECT_EQ(text(), text1);
  keys("g");
  key(Qt::Key_Escape);  // nothing had moved: the earlier step stays
  EXPECT_EQ(text(), text1);
  keys("gz4");
  QTest::mouseClick(&view(), Qt::RightButton, {}, QPoint(300, 300));
  EXPECT_EQ(text(), text1);
  EXPECT_EQ(editor().selection(), Selection::ofPoints({point}));
  // A drag back to the start, then Escape: the same.
  keys("gx2");
  key(Qt::Key_Backspace);
  keys("0");
  key(Qt::Key_Escape);
  EXPECT_EQ(text(), text1);
  EXPECT_EQ(steps(), 1);
}

TEST_F(PointTools, ShortcutsSleepDuringAMotion) {
  selectOne();
  keys("gx3");
  const std::string moving = text();
  QTest::keyClick(&view(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(text(), moving);
  // A menu entry chosen with the mouse ends the motion.
  editor().undo();
  EXPECT_FALSE(editor().session().document().canUndo());
  key(Qt::Key_Escape);
  EXPECT_FALSE(editor().session().document().canUndo());
}

TEST_F(PointTools, TheNormalMovesOutwards) {
  const int point = selectOne();
  const Vector3d from = places()[point];
  const Vector3d normal = meanNormal({point}, *editor().solid());
  keys("gn2");
  key(Qt::Key_Return);
  EXPECT_NEAR((places()[point] - from - 2 * normal).norm(), 0, 1e-12);
  action("Move along normal")->setEnabled(true);
  withDialog<NumberDialog>([&] { action("Move along normal")->trigger(); },
                           [&](NumberDialog& dialog) {
                             auto* field = dialog.findChild<QuantityEdit*>();
                             field->setFocus();
                             QTest::keyClicks(field, "much");
                             keepPicture("move-along-normal", &dialog);
                             dialog.accept();
                             EXPECT_TRUE(dialog.isVisible());
                             field->selectAll();
                             QTest::keyClicks(field, "-0.1 cm");
                             dialog.accept();
                           });
  EXPECT_NEAR((places()[point] - from).norm(), 1, 0.2);
}

TEST_F(PointTools, ArrowKeysNudgeAlongTheNearestAxis) {
  const int point = selectOne();
  window_->viewport().viewport().lookFrom(view::StandardView::kFront);
  const Vector3d from = places()[point];
  key(Qt::Key_Right);
  const Vector3d by = places()[point] - from;
  EXPECT_GT(by.x(), 0);
  EXPECT_EQ(by.y(), 0);
  EXPECT_EQ(by.z(), 0);
  key(Qt::Key_Up, Qt::ShiftModifier);
  EXPECT_NEAR((places()[point] - from - by).z(), 10 * by.x(), 1e-9);
  EXPECT_EQ(steps(), 2);
}

TEST_F(PointTools, TurningAndScalingByNumbers) {
  const std::set<int> points = pointsOfPatch(*editor().solid(), 0);
  editor().select(Selection::ofPoints(points));
  const Vector3d centre = meanOf(points, *editor().solid());
  const int point = *points.begin();
  const Vector3d arm = places()[point] - centre;
  action("Rotate")->trigger();
  EXPECT_EQ(editor().selection().points, points);  // unchanged by another tool
  view().setFocus();
  keys("z30");
  keepPicture("rotate");
  key(Qt::Key_Return);
  const Vector3d turned = places()[point] - centre;
  EXPECT_NEAR(turned.z(), arm.z(), 1e-9);
  EXPECT_NEAR(turned.x(),
              arm.x() * std::cos(std::numbers::pi / 6) - arm.y() * std::sin(std::numbers::pi / 6),
              1e-9);
  editor().undo();
  action("Scale")->trigger();
  view().setFocus();
  keys("x1.5");
  keepPicture("scale");
  key(Qt::Key_Return);
  const Vector3d scaled = places()[point] - centre;
  EXPECT_NEAR(scaled.x(), 1.5 * arm.x(), 1e-9);
  EXPECT_NEAR(scaled.y(), arm.y(), 1e-9);
  EXPECT_EQ(steps(), 1);
}

TEST_F(PointTools, CtrlTurnsInSteps) {
  const std::set<int> points = pointsOfPatch(*editor().solid(), 0);
  editor().select(Selection::ofPoints(points));
  const Vector3d centre = meanOf(points, *editor().solid());
  action("Rotate")->trigger();
  view().setFocus();
  view().viewport().lookFrom(view::StandardView::kTop);
  const int point = *points.begin();
  const Vector3d arm = places()[point] - centre;
  const QPoint middle = pixelOf(centre);
  moveTo(middle + QPoint(100, 0));
  keys("z");
  moveTo(middle + QPoint(90, -80), Qt::NoButton, Qt::ControlModifier);  // 42 degrees
  const Vector3d turned = places()[point] - centre;
  const double s = std::sqrt(0.5);
  EXPECT_NEAR((turned - Vector3d(s * (arm.x() - arm.y()), s * (arm.x() + arm.y()), arm.z())).norm(),
              0, 1e-6);
  key(Qt::Key_Return);
}

TEST_F(PointTools, FalloffAndMirrorTakeOthersAlong) {
  const int point = selectOne();
  options_->setHasFalloff(true);
  options_->setFalloff(30);
  const auto reach = options_->reach(*editor().solid());
  const std::set<int> followers = followersOf({point}, reach, *editor().solid());
  ASSERT_FALSE(followers.empty());
  const std::vector<Vector3d> before = places();
  moveTo(pixelOfPoint(point));
  keys("gx2");
  keepPicture("falloff");
  // Smooth edges may move further points.
  EXPECT_EQ(places()[point], before[point] + Vector3d(2, 0, 0));
  for (int follower : followers) EXPECT_NE(places()[follower], before[follower]) << follower;
  // The wheel increases the falloff of the present motion.
  const double radius = options_->falloff();
  QWheelEvent wheel(QPointF(300, 300), view().mapToGlobal(QPointF(300, 300)), {}, {0, 120},
                    Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
  QApplication::sendEvent(&view(), &wheel);
  EXPECT_GT(options_->falloff(), radius);
  key(Qt::Key_Return);
  EXPECT_EQ(steps(), 1);
  EXPECT_EQ(places(), before);
  options_->setHasFalloff(false);
  options_->setMirror(PointOptions::Mirror::kMiddleX);
  const std::set<int> images =
      followersOf({point}, options_->reach(*editor().solid()), *editor().solid());
  keys("gz2");
  key(Qt::Key_Return);
  for (int image : images) EXPECT_NEAR(places()[image].z() - before[image].z(), 2, 1e-9);
  EXPECT_LE(images.size(), 1u);
}

TEST_F(PointTools, OptionsCanBeSetByHand) {
  QWidget holder;
  QWidget* fields = window_->tools().active().makeOptions(&holder);
  holder.resize(360, 160);
  fields->resize(holder.size());
  holder.show();
  keepPicture("options", &holder);
  QTest::mouseClick(fields->findChild<QAbstractButton*>("patch"), Qt::LeftButton);
  EXPECT_EQ(options_->pick(), PointOptions::Pick::kPatches);
  EXPECT_TRUE(action("Pick patches")->isChecked());
  fields->findChild<QAbstractButton*>("falloff")->click();
  auto* radius = fields->findChild<QuantityEdit*>("falloffRadius");
  EXPECT_TRUE(radius->isEnabled());
  radius->setFocus();
  radius->selectAll();
  QTest::keyClicks(radius, "1 cm");
  QTest::keyClick(radius, Qt::Key_Return);
  EXPECT_NEAR(options_->falloff(), 10, 1e-12);
  QTest::keyClick(fields->findChild<QComboBox*>("mirror"), Qt::Key_Down);
  EXPECT_EQ(options_->mirror(), PointOptions::Mirror::kX);
}

TEST_F(PointTools, PatchesAndEdgesArePicked) {
  const QPoint middle = view().rect().center();
  action("Pick patches")->trigger();
  EXPECT_EQ(options_->pick(), PointOptions::Pick::kPatches);
  moveTo(middle);
  QTest::mouseClick(&view(), Qt::LeftButton, {}, middle);
  ASSERT_EQ(editor().selection().patches.size(), 1u);
  const int patch = *editor().selection().patches.begin();
  moveTo(QPoint(5, 5));
  keepPicture("patch");
  // A selected patch is dragged with all its points.
  const Vector3d before = meanOf(pointsOfPatch(*editor().solid(), patch), *editor().solid());
  keys("gz3");
  key(Qt::Key_Return);
  EXPECT_NEAR(meanOf(pointsOfPatch(*editor().solid(), patch), *editor().solid()).z(),
              before.z() + 3, 1e-9);
  action("Points of patches and edges")->trigger();
  EXPECT_EQ(editor().selection().points, pointsOfPatch(*editor().solid(), patch));
  QTest::mouseClick(&view(), Qt::LeftButton, {}, QPoint(5, 5));
  EXPECT_TRUE(editor().selection().empty());
  options_->setPick(PointOptions::Pick::kPoints);
  options_->setPick(PointOptions::Pick::kEdges);
  action("All")->trigger();
  EXPECT_EQ(editor().selection().edges.size(), editor().solid()->edges().size());
  keepPicture("edges");
}

TEST_F(PointTools, EdgesLieWhereTheyArePicked) {
  options_->setPick(PointOptions::Pick::kEdges);
  int picked = 0;
  for (int edge = 0; edge < int(editor().solid()->edges().size()); ++edge) {
    // The middle control point of the edge is near the edge of the sphere's patch.
    const std::set<int> points = pointsOfEdge(*editor().solid(), edge);
    const auto [a, b] = editor().solid()->edges()[edge].vertices;
    EXPECT_TRUE(points.contains(a) && points.contains(b));
    const QPoint corner = pixelOfPoint(a);
    const QPoint along = corner + (pixelOfPoint(b) - corner) / 8;
    QTest::mouseClick(&view(), Qt::LeftButton, {}, along);
    picked += editor().selection().edges == std::set<int>{edge};
  }
  EXPECT_GE(picked, 1);
}

TEST_F(PointTools, SelectionsGrowShrinkAndInvert) {
  const int point = selectOne();
  action("Grow")->trigger();
  const std::set<int> grownPoints = editor().selection().points;
  EXPECT_GE(grownPoints.size(), 4u);
  action("Shrink")->trigger();
  EXPECT_EQ(editor().selection(), Selection::ofPoints({point}));
  action("Invert")->trigger();
  EXPECT_EQ(editor().selection().points.size(), places().size() - 1);
  action("None")->trigger();
  EXPECT_TRUE(editor().selection().empty());
  EXPECT_FALSE(action("Grow")->isEnabled());
}

TEST_F(PointTools, BoxesAddWithShiftAndRemoveWithCtrl) {
  const QRect all = view().rect().adjusted(4, 4, -4, -4);
  drag(all.topLeft(), all.bottomRight());
  const std::size_t count = editor().selection().points.size();
  EXPECT_EQ(count, places().size());
  const QPoint corner = all.topLeft();
  drag(corner, QPoint(all.center().x(), all.bottom()), Qt::ControlModifier);
  const std::size_t right = editor().selection().points.size();
  EXPECT_LT(right, count);
  EXPECT_GT(right, 0u);
  drag(corner, QPoint(all.center().x(), all.bottom()), Qt::ShiftModifier);
  EXPECT_EQ(editor().selection().points.size(), count);
}

TEST_F(PointTools, ADoubleClickSelectsThePointsOfAPatch) {
  QPoint at = view().rect().center();
  while (view().viewport().controlPointAt({at.x(), at.y()})) at += QPoint(7, 3);
  QTest::mouseDClick(&view(), Qt::LeftButton, {}, at);
  const std::set<int> points = editor().selection().points;
  ASSERT_FALSE(points.empty());
  bool isPatch = false;
  for (int patch = 0; patch < int(editor().solid()->patches().size()); ++patch)
    isPatch |= points == pointsOfPatch(*editor().solid(), patch);
  EXPECT_TRUE(isPatch);
}

TEST_F(PointTools, DeleteSaysWhyNot) {
  selectOne();
  const std::string text0 = text();
  QSignalSpy refused(&editor(), &Editor::refused);
  key(Qt::Key_Delete);
  ASSERT_EQ(refused.count(), 1);
  EXPECT_TRUE(refused[0][0].toString().contains("knot"));
  EXPECT_EQ(text(), text0);
}

TEST_F(PointTools, ExactPlacesAndPlanes) {
  const int point = selectOne();
  withDialog<NumberDialog>([&] { action("Move to")->trigger(); },
                           [&](NumberDialog& dialog) {
                             keepPicture("move-to", &dialog);
                             auto* place = dialog.findChild<VectorEdit*>();
                             place->component(0).setFocus();
                             place->component(0).selectAll();
                             QTest::keyClicks(&place->component(0), "1.1");
                             QTest::keyClick(&place->component(0), Qt::Key_Return);
                           });
  EXPECT_EQ(places()[point].x(), 1.1);
  QSignalSpy refused(&editor(), &Editor::refused);
  action("Best fit")->trigger();  // one point has no best plane
  EXPECT_EQ(refused.count(), 1);
  editor().select(Selection::ofPoints(pointsOfPatch(*editor().solid(), 0)));
  action("Across z")->trigger();
  std::set<double> heights;
  for (int each : editor().selection().points) heights.insert(std::round(places()[each].z() * 1e6));
  EXPECT_EQ(refused.count() + int(heights.size() == 1), 2);
}

}  // namespace
}  // namespace palpa::gui
