#include "app/view/camera/view_cube.h"
#include "app/gui/view/quick_resolution.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

using Arrow = view::ViewCubePart::Arrow;
using Eigen::Vector3d;

class ViewCubeInWindow : public WindowTest {
 protected:
  ViewCubeInWindow() { EXPECT_TRUE(window_->openFile(kSphere)); }

  /// A pixel of the part; fails if it cannot be seen.
  QPoint pixelOfPart(const view::ViewCubePart& part) {
    const int side = static_cast<int>(view::kViewCubeSide) + 8;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    int count = 0;
    for (int x = view().width() - side; x < view().width(); ++x) {
      for (int y = 0; y < side; ++y) {
        if (view().viewport().cubePartAt({x, y}) != part) continue;
        sum += Eigen::Vector2d(x, y);
        ++count;
      }
    }
    EXPECT_GT(count, 20);
    sum /= std::max(count, 1);
    return {static_cast<int>(sum.x()), static_cast<int>(sum.y())};
  }
  void click(const view::ViewCubePart& part) {
    QTest::mouseClick(&view(), Qt::LeftButton, {}, pixelOfPart(part));
  }
  Vector3d direction() { return view().viewport().camera().direction; }
};

TEST_F(ViewCubeInWindow, AClickTurnsToTheSide) {
  const std::string before = text();
  editor().select(Selection::ofPoints({0}));
  click({{0, -1, 0}, Arrow::kNone});
  EXPECT_NEAR((direction() - Vector3d(0, 1, 0)).norm(), 0, 1e-9);
  click({{1, -1, 0}, Arrow::kNone});
  EXPECT_NEAR((direction() - Vector3d(-1, 1, 0).normalized()).norm(), 0, 1e-9);
  click({{1, -1, 1}, Arrow::kNone});
  EXPECT_NEAR((direction() - Vector3d(-1, 1, -1).normalized()).norm(), 0, 1e-9);
  // The second of two quick clicks is a double click of the window system.
  action("Front")->trigger();
  const QPoint right = pixelOfPart({Eigen::Vector3i::Zero(), Arrow::kRight});
  QTest::mouseClick(&view(), Qt::LeftButton, {}, right);
  QMouseEvent second(QEvent::MouseButtonDblClick, right, view().mapToGlobal(right), Qt::LeftButton,
                     Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&view(), &second);
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, right);
  EXPECT_NEAR((direction() - Vector3d(0, -1, 0)).norm(), 0, 1e-9);
  // The tool has noticed nothing.
  EXPECT_EQ(editor().selection(), Selection::ofPoints({0}));
  EXPECT_EQ(text(), before);
}

TEST_F(ViewCubeInWindow, ADragOfTheCubeOrbits) {
  const QPoint at = pixelOfPart({{0, -1, 0}, Arrow::kNone});
  const Vector3d before = direction();
  drag(at, at + QPoint(-60, 20));
  const Vector3d after = direction();
  EXPECT_GT((after - before).norm(), 0.2);
  // After the release the pointer moves freely.
  moveTo(at + QPoint(-90, 90));
  EXPECT_EQ(direction(), after);
}

TEST_F(ViewCubeInWindow, LightsUpUnderThePointer) {
  const auto picture = [&] { return view().grab().toImage(); };
  const QPoint at = pixelOfPart({{0, -1, 0}, Arrow::kNone});
  const QPoint beside = at + QPoint(-12, 12);  // free of the word
  const QColor plain = picture().pixelColor(beside);
  moveTo(at);
  const QColor lit = picture().pixelColor(beside);
  keepPicture("view-cube-hovered");
  EXPECT_GT(lit.red() - lit.blue(), 80 + plain.red() - plain.blue());
  EXPECT_EQ(view().cursor().shape(), Qt::PointingHandCursor);
  moveTo(view().rect().center());
  EXPECT_EQ(picture().pixelColor(beside), plain);
}

TEST_F(ViewCubeInWindow, IsHiddenByTheMenuAndStored) {
  const QPoint at = pixelOfPart({{0, -1, 0}, Arrow::kNone});
  action("View cube")->setChecked(false);
  EXPECT_FALSE(view().viewport().cubePartAt({at.x(), at.y()}));
  const QString file = folder_.filePath("cube.json");
  ASSERT_TRUE(editor().saveAs(file));
  restart();
  EXPECT_TRUE(action("View cube")->isChecked());
  ASSERT_TRUE(window_->openFile(file));
  EXPECT_FALSE(action("View cube")->isChecked());
}

TEST_F(ViewCubeInWindow, PicturesHaveNone) {
  const QString with = folder_.filePath("with.png"), without = folder_.filePath("without.png");
  view().writePicture(with.toStdString(), view().size());
  EXPECT_TRUE(view().viewport().isViewCubeVisible());
  action("View cube")->setChecked(false);
  view().writePicture(without.toStdString(), view().size());
  EXPECT_EQ(QImage(with), QImage(without));
}

TEST_F(ViewCubeInWindow, MessagesLieBesideIt) {
  const int side = static_cast<int>(view::kViewCubeSide);
  for (const int width : {1600, 1280, 900}) {
    window_->resize(width, 800);
    window_->messages().clear();
    window_->messages().showError("A message that is long enough for several words: " +
                                  QString("where, what and how to mend it; ").repeated(6));
    QTest::qWait(30);
    const QRect cube(view().width() - side, 0, side, side);
    const QRect shown = window_->messages().geometry();
    EXPECT_FALSE(shown.intersects(cube)) << width;
    EXPECT_GE(shown.left(), 0) << width;
    EXPECT_GE(shown.width(), 260) << width;
  }
  keepPicture("messages-beside-the-cube");
}

TEST_F(ViewCubeInWindow, AMotionByKeysEndsWithAClickOnIt) {
  const int point = visiblePoint();
  editor().select(Selection::ofPoints({point}));
  moveTo(pixelOfPoint(point));
  const QPoint at = pixelOfPart({{0, -1, 0}, Arrow::kNone});
  const Vector3d before = direction();
  QTest::keyClick(&view(), Qt::Key_G);
  moveTo(at);
  QTest::mouseClick(&view(), Qt::LeftButton, {}, at);
  EXPECT_EQ(direction(), before);
  EXPECT_TRUE(editor().session().document().canUndo());
  moveTo(view().rect().center());
  editor().undo();
}

TEST(QuickResolution, FollowsTheTimeOfPictures) {
  QuickResolution quick;
  for (int i = 0; i < 20; ++i) quick.drawn(9);
  EXPECT_EQ(quick.share(), 1);
  // Many slow pictures: fewer pixels; one slow picture is no reason.
  quick.drawn(30);
  EXPECT_EQ(quick.share(), 1);
  for (int i = 0; i < 20 && quick.share() == 1; ++i) quick.drawn(32);
  const double less = quick.share();
  EXPECT_LT(less, 1);
  // As fast as the smaller picture is then: it stays.
  const double time = 32 * (0.2 + 0.8 * less * less);
  for (int i = 0; i < 40; ++i) quick.drawn(time);
  EXPECT_EQ(quick.share(), less);
  // A small window: all pixels again.
  for (int i = 0; i < 40; ++i) quick.drawn(4);
  EXPECT_EQ(quick.share(), 1);
  for (int i = 0; i < 40; ++i) quick.drawn(300);
  EXPECT_EQ(quick.share(), 0.5);
}

}  // namespace
}  // namespace palpa::gui
