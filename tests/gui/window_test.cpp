#include <gtest/gtest.h>

#include <QAction>
#include <QDir>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <set>

#include "app/gui/appearance.h"
#include "app/gui/main_window.h"
#include "modeling/project/project_file.h"

namespace palpa::gui {
namespace {

const QString kSphere = PALPA_PROJECTS "/sphere.json";

class Window : public testing::Test {
 protected:
  Window() {
    qputenv("XDG_STATE_HOME", folder_.path().toUtf8());
    window_ = std::make_unique<MainWindow>();
    window_->show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(window_.get()));
  }

  void waitForModel() {
    ASSERT_TRUE(QTest::qWaitFor(
        [this] {
          return window_->editor().rebuildStatus().state == app::RebuildStatus::State::kUpToDate;
        },
        60000));
    QTest::qWait(50);
  }

  ViewportWidget& view() { return window_->viewport(); }
  Editor& editor() { return window_->editor(); }
  std::string text() { return modeling::toJson(editor().project()); }

  QPoint pixelOf(int point) {
    const Eigen::Vector2d pixel =
        view().viewport().toPixel(editor().solid()->controlPoints()[point]) /
        view().devicePixelRatioF();
    return {static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y()))};
  }

  /// A control point that can be seen and picked where it is drawn.
  int visiblePoint() {
    for (int i = 0; i < static_cast<int>(editor().solid()->controlPoints().size()); ++i) {
      const QPoint at = pixelOf(i);
      if (view().rect().adjusted(50, 50, -50, -50).contains(at) &&
          view().viewport().controlPointAt({at.x(), at.y()}) == i)
        return i;
    }
    return -1;
  }

  void drag(QPoint from, QPoint to, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    QTest::mousePress(&view(), Qt::LeftButton, modifiers, from);
    for (int i = 1; i <= 5; ++i) {
      const QPoint at = from + (to - from) * i / 5;
      QMouseEvent event(QEvent::MouseMove, at, view().mapToGlobal(at), Qt::NoButton, Qt::LeftButton,
                        modifiers);
      QApplication::sendEvent(&view(), &event);
    }
    QTest::mouseRelease(&view(), Qt::LeftButton, modifiers, to);
  }

  QTemporaryDir folder_;
  std::unique_ptr<MainWindow> window_;
};

TEST_F(Window, ADraggedPointMovesTheBodyAndTheModelFollows) {
  ASSERT_TRUE(window_->openFile(kSphere));
  waitForModel();
  const auto before = editor().model();
  const std::string text0 = text();
  const int point = visiblePoint();
  ASSERT_GE(point, 0);
  const Eigen::Vector3d place = editor().solid()->controlPoints()[point];
  const QPoint pixel = pixelOf(point);
  drag(pixel, pixel + QPoint(40, -20));
  EXPECT_EQ(editor().selection(), std::set<int>{point});
  const Eigen::Vector3d moved = editor().solid()->controlPoints()[point];
  EXPECT_GT((moved - place).norm(), 0.5);
  // The point is drawn where the pointer let it go.
  EXPECT_LE((pixelOf(point) - (pixel + QPoint(40, -20))).manhattanLength(), 2);
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
  const QPoint pixel = pixelOf(point);
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
  EXPECT_EQ(editor().selection().size(), editor().solid()->controlPoints().size());
  QTest::keyClick(&view(), Qt::Key_Escape);
  EXPECT_TRUE(editor().selection().empty());
  const int point = visiblePoint();
  QTest::mouseClick(&view(), Qt::LeftButton, {}, pixelOf(point));
  EXPECT_EQ(editor().selection().size(), 1u);
  QTest::mouseClick(&view(), Qt::LeftButton, Qt::ShiftModifier, pixelOf(point));
  EXPECT_TRUE(editor().selection().empty());
}

TEST_F(Window, WhatIsSavedIsOpenedAgain) {
  ASSERT_TRUE(window_->openFile(kSphere));
  const QString file = folder_.filePath("ball.json");
  const QPoint pixel = pixelOf(visiblePoint());
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

/// How many different colours a picture has.
std::size_t colours(const QImage& image) {
  std::set<QRgb> found;
  for (int y = 0; y < image.height(); y += 3)
    for (int x = 0; x < image.width(); x += 3) found.insert(image.pixel(x, y));
  return found.size();
}

/// With PALPA_PICTURES set to a folder, the pictures are kept there to be looked at.
TEST_F(Window, ShowsTheBodyInBothThemes) {
  ASSERT_TRUE(window_->openFile(kSphere));
  waitForModel();
  QTest::mouseClick(&view(), Qt::LeftButton, {}, pixelOf(visiblePoint()));
  for (const Theme theme : {Theme::kDark, Theme::kLight}) {
    applyTheme(*qApp, theme);
    view().viewport().setTheme(viewportTheme(theme));
    view().update();
    QTest::qWait(400);
    const QImage picture = window_->grab().toImage();
    EXPECT_GT(colours(picture), 500u);
    const QColor corner = picture.pixelColor(2, picture.height() / 2);
    EXPECT_EQ(corner.lightness() < 128, theme == Theme::kDark);
    if (const QString folder = qEnvironmentVariable("PALPA_PICTURES"); !folder.isEmpty())
      picture.save(folder + (theme == Theme::kDark ? "/dark.png" : "/light.png"));
  }
}

}  // namespace
}  // namespace palpa::gui
