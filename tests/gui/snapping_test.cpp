#include <QCheckBox>

#include "app/gui/document/point_groups.h"
#include "app/gui/tools/point_options.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

using Eigen::Vector3d;

class Snapping : public WindowTest {
 protected:
  Snapping() {
    EXPECT_TRUE(window_->openFile(kSphere));
    options_ = window_->findChild<PointOptions*>();
    QApplication::setActiveWindow(window_.get());
    view().setFocus();
    point_ = innerPoint();
    editor().select(Selection::ofPoints({point_}));
  }

  /// A visible point within a patch: smooth edges do not move it further than it is dragged.
  int innerPoint() {
    const modeling::Solid& solid = *editor().solid();
    for (int i = 0; i < static_cast<int>(solid.controlPoints().size()); ++i) {
      const QPoint at = pixelOfPoint(i);
      int patches = 0;
      for (int patch = 0; patch < static_cast<int>(solid.patches().size()); ++patch)
        patches += pointsOfPatch(solid, patch).contains(i);
      if (patches == 1 && view().viewport().controlPointAt({at.x(), at.y()}) == i &&
          isAwayFromEdges(i))
        return i;
    }
    ADD_FAILURE() << "no inner point is visible";
    return 0;
  }
  /// Not among the points beside an edge, which smooth edges couple.
  bool isAwayFromEdges(int point) {
    const modeling::Solid& solid = *editor().solid();
    const std::set<int> around = grown({point}, solid);
    for (int edge = 0; edge < static_cast<int>(solid.edges().size()); ++edge)
      for (const int other : pointsOfEdge(solid, edge))
        if (around.contains(other)) return false;
    return true;
  }
  const Vector3d& place() { return editor().solid()->controlPoints()[point_]; }
  /// Another control point in front, some way from the first.
  int other() {
    const auto& points = editor().solid()->controlPoints();
    for (int i = 0; i < static_cast<int>(points.size()); ++i) {
      const QPoint at = pixelOfPoint(i);
      const bool isApart = (at - pixelOfPoint(point_)).manhattanLength() > 60;
      if (isApart && view().viewport().controlPointAt({at.x(), at.y()}) == i) return i;
    }
    ADD_FAILURE() << "no other point is visible";
    return 0;
  }
  /// Drags the point without releasing the button.
  void dragTo(QPoint to, Qt::KeyboardModifiers modifiers = {}) {
    const QPoint from = pixelOfPoint(point_);
    QTest::mousePress(&view(), Qt::LeftButton, {}, from);
    moveTo(from + (to - from) / 2, Qt::LeftButton, modifiers);
    moveTo(to, Qt::LeftButton, modifiers);
  }
  void release(QPoint at) { QTest::mouseRelease(&view(), Qt::LeftButton, {}, at); }
  /// A free place beside the body.
  QPoint beside() { return {60, view().height() / 3}; }
  static double offGrid(double value, double step) {
    return std::abs(value - std::round(value / step) * step);
  }

  PointOptions* options_ = nullptr;
  int point_ = 0;
};

TEST_F(Snapping, CtrlTakesThePointToAnotherPoint) {
  const Vector3d target = editor().solid()->controlPoints()[other()];
  const QPoint at = pixelOf(target) + QPoint(3, -2);
  dragTo(at);
  EXPECT_GT((place() - target).norm(), 1e-3);  // without Ctrl: under the pointer
  moveTo(at, Qt::LeftButton, Qt::ControlModifier);
  EXPECT_NEAR((place() - target).norm(), 0, 1e-12);
  keepPicture("snap-point");
  release(at);
  EXPECT_NEAR((place() - target).norm(), 0, 1e-12);
  EXPECT_TRUE(editor().session().document().canUndo());
  editor().undo();
  EXPECT_FALSE(editor().session().document().canUndo());
}

TEST_F(Snapping, WithoutAPointThereItGoesToTheGrid) {
  const double step = view().viewport().gridSpacing();
  dragTo(beside(), Qt::ControlModifier);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(offGrid(place()[k], step), 0, 1e-9) << place()[k];
  keepPicture("snap-grid");
  release(beside());
}

TEST_F(Snapping, ACoordinateThatIsNotMovedStays) {
  action("Front")->trigger();
  point_ = innerPoint();
  editor().perform(modeling::MovePoints{
      modeling::PointSelection::of({point_}), modeling::MoveBy{{0, -1.37, 0}}, {}});
  editor().select(Selection::ofPoints({point_}));
  const double depth = place().y(), step = view().viewport().gridSpacing();
  ASSERT_GT(offGrid(depth, step), 1e-6);
  dragTo(beside(), Qt::ControlModifier);
  ASSERT_EQ(editor().selection(), Selection::ofPoints({point_}));
  EXPECT_NEAR(place().y(), depth, 1e-9);
  EXPECT_NEAR(offGrid(place().x(), step), 0, 1e-9);
  release(beside());
}

TEST_F(Snapping, AnAxisTakesTheCoordinateOfTheTarget) {
  const Vector3d from = place();
  const int point = other();
  const Vector3d target = editor().solid()->controlPoints()[point];
  moveTo(pixelOfPoint(point_));
  QTest::keyClick(&view(), Qt::Key_X);
  moveTo(pixelOfPoint(point), Qt::NoButton, Qt::ControlModifier);
  EXPECT_NEAR((place() - Vector3d(target.x(), from.y(), from.z())).norm(), 0, 1e-9);
  QTest::keyClick(&view(), Qt::Key_Escape);
  EXPECT_EQ(place(), from);
}

TEST_F(Snapping, TheOptionReversesCtrl) {
  action("Snap while moving")->trigger();
  EXPECT_TRUE(options_->snaps());
  const double step = view().viewport().gridSpacing();
  dragTo(beside());
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(offGrid(place()[k], step), 0, 1e-9);
  moveTo(beside() + QPoint(1, 0), Qt::LeftButton, Qt::ControlModifier);
  EXPECT_GT(offGrid(place().x(), step) + offGrid(place().z(), step), 1e-6);
  release(beside());
  // Typed numbers are exact.
  const Vector3d from = place();
  for (const char* key : {"g", "x", "1", ".", "2", "3"}) QTest::keyClicks(&view(), key);
  QTest::keyClick(&view(), Qt::Key_Return);
  EXPECT_NEAR((place() - from - Vector3d(1.23, 0, 0)).norm(), 0, 1e-12);
  QWidget holder;
  QWidget* fields = window_->tools().active().makeOptions(&holder);
  auto* box = fields->findChild<QCheckBox*>("snap");
  EXPECT_TRUE(box->isChecked());
  box->click();
  EXPECT_FALSE(options_->snaps());
  EXPECT_FALSE(action("Snap while moving")->isChecked());
}

TEST_F(Snapping, EdgesAttractWhereNoPointIs) {
  const modeling::Solid& solid = *editor().solid();
  // A place on a visible edge that is away from all control points.
  std::optional<QPoint> at;
  for (int edge = 0; edge < static_cast<int>(solid.edges().size()) && !at; ++edge) {
    if (pointsOfEdge(solid, edge).contains(point_)) continue;
    const auto [a, b] = solid.edges()[edge].vertices;
    for (int k = 1; k < 60 && !at; ++k) {
      const Vector3d chord = solid.controlPoints()[a] +
                             k / 60.0 * (solid.controlPoints()[b] - solid.controlPoints()[a]);
      const QPoint pixel = pixelOf(25 * chord.normalized());  // edges are great circles
      const Eigen::Vector2d device(pixel.x(), pixel.y());
      if (!view().rect().contains(pixel) || !view().viewport().borderAt(device, 2)) continue;
      bool isFree = true;
      for (int i = 0; i < static_cast<int>(solid.controlPoints().size()); ++i)
        isFree = isFree && (pixelOfPoint(i) - pixel).manhattanLength() > 25;
      if (isFree) at = pixel;
    }
  }
  ASSERT_TRUE(at);
  dragTo(*at + QPoint(2, 1), Qt::ControlModifier);
  // On the sphere, up to the pieces that the edge is drawn of.
  EXPECT_NEAR(place().norm(), 25, 0.1);
  keepPicture("snap-edge");
  release(*at);
}

}  // namespace
}  // namespace palpa::gui
