#include <QSignalSpy>
#include <set>

#include "app/gui/base/appearance.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

using Window = WindowTest;

TEST_F(Window, ADraggedPointMovesTheBodyAndTheModelFollows) {
  ASSERT_TRUE(window_->openFile(kSphere));
  waitForModel();
  const auto before = editor().model();
  const std::string text0 = text();
  const int point = visiblePoint();
  ASSERT_GE(point, 0);
  const Eigen::Vector3d place = editor().solid()->controlPoints()[point];
  const QPoint pixel = pixelOfPoint(point);
  drag(pixel, pixel + QPoint(40, -20));
  EXPECT_EQ(editor().selection(), Selection::ofPoints({point}));
  const Eigen::Vector3d moved = editor().solid()->controlPoints()[point];
  EXPECT_GT((moved - place).norm(), 0.5);
  // The point is drawn at the release of the pointer.
  EXPECT_LE((pixelOfPoint(point) - (pixel + QPoint(40, -20))).manhattanLength(), 2);
  EXPECT_TRUE(window_->isWindowModified());
  waitForModel();
  EXPECT_NE(editor().model()->surface().positions, before->surface().positions);
  // One drag is one step.
  editor().undo();
  EXPECT_EQ(text(), text0);
  EXPECT_FALSE(window_->isWindowModified());
  EXPECT_FALSE(editor().session().document().canUndo());
  editor().redo();
  EXPECT_EQ(editor().solid()->controlPoints()[point], moved);
}

TEST_F(Window, EscapeTakesADragBack) {
  ASSERT_TRUE(window_->openFile(kSphere));
  const std::string text0 = text();
  const int point = visiblePoint();
  const QPoint pixel = pixelOfPoint(point);
  QTest::mousePress(&view(), Qt::LeftButton, {}, pixel);
  QMouseEvent event(QEvent::MouseMove, pixel + QPoint(30, 30),
                    view().mapToGlobal(pixel + QPoint(30, 30)), Qt::NoButton, Qt::LeftButton,
                    Qt::NoModifier);
  QApplication::sendEvent(&view(), &event);
  EXPECT_NE(text(), text0);
  QTest::keyClick(&view(), Qt::Key_Escape);
  EXPECT_EQ(text(), text0);
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, pixel);
  EXPECT_EQ(text(), text0);
}

TEST_F(Window, ABoxSelectsAndShiftAdds) {
  ASSERT_TRUE(window_->openFile(kSphere));
  const QRect all = view().rect().adjusted(4, 4, -4, -4);
  drag(all.topLeft(), all.bottomRight());
  EXPECT_EQ(editor().selection().points.size(), editor().solid()->controlPoints().size());
  QTest::keyClick(&view(), Qt::Key_Escape);
  EXPECT_TRUE(editor().selection().empty());
  const int point = visiblePoint();
  QTest::mouseClick(&view(), Qt::LeftButton, {}, pixelOfPoint(point));
  EXPECT_EQ(editor().selection().points.size(), 1u);
  QTest::mouseClick(&view(), Qt::LeftButton, Qt::ShiftModifier, pixelOfPoint(point));
  EXPECT_TRUE(editor().selection().empty());
}

TEST_F(Window, WhatIsSavedIsOpenedAgain) {
  ASSERT_TRUE(window_->openFile(kSphere));
  const QString file = folder_.filePath("ball.json");
  const QPoint pixel = pixelOfPoint(visiblePoint());
  drag(pixel, pixel + QPoint(25, 10));
  ASSERT_TRUE(editor().saveAs(file));
  EXPECT_FALSE(window_->isWindowModified());
  const std::string saved = text();
  ASSERT_TRUE(window_->openFile(kSphere));
  EXPECT_NE(text(), saved);
  ASSERT_TRUE(window_->openFile(file));
  EXPECT_EQ(text(), saved);
}

TEST_F(Window, AFileThatCannotBeReadIsSaidAndTheProjectStays) {
  ASSERT_TRUE(window_->openFile(kSphere));
  const std::string text0 = text();
  QSignalSpy refused(&editor(), &Editor::refused);
  EXPECT_FALSE(window_->openFile("/no/such/file.json"));
  EXPECT_FALSE(window_->openFile("/no/such/file.step"));
  EXPECT_EQ(refused.count(), 2);
  EXPECT_EQ(text(), text0);
}

TEST_F(Window, CanBeClosedWhileTheModelIsBuilt) {
  ASSERT_TRUE(window_->openFile(kSphere));
  window_.reset();
}

/// Number of different colours in a picture.
std::size_t colours(const QImage& image) {
  std::set<QRgb> found;
  for (int y = 0; y < image.height(); y += 3)
    for (int x = 0; x < image.width(); x += 3) found.insert(image.pixel(x, y));
  return found.size();
}

TEST_F(Window, ShowsTheBodyInBothThemes) {
  ASSERT_TRUE(window_->openFile(kSphere));
  waitForModel();
  QTest::mouseClick(&view(), Qt::LeftButton, {}, pixelOfPoint(visiblePoint()));
  for (const Theme theme : {Theme::kDark, Theme::kLight}) {
    window_->settings().setTheme(theme);
    QTest::qWait(400);
    const QImage picture = window_->grab().toImage();
    EXPECT_GT(colours(picture), 500u);
    const QColor corner = picture.pixelColor(2, picture.height() / 2);
    EXPECT_EQ(corner.lightness() < 128, theme == Theme::kDark);
    keepPicture(theme == Theme::kDark ? "window-dark" : "window-light");
  }
}

}  // namespace
}  // namespace palpa::gui
