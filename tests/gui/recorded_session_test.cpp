#include <QComboBox>
#include <QFileDialog>

#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

/// A session with keys and mouse only.
class RecordedSession : public WindowTest {
 protected:
  void press(Qt::Key key, Qt::KeyboardModifiers modifiers = {}) {
    QTest::keyClick(&view(), key, modifiers);
  }
  /// Answers the file dialog opened by `keys`.
  void chooseFile(Qt::Key key, Qt::KeyboardModifiers modifiers, const QString& file) {
    withDialog<QFileDialog>([&] { press(key, modifiers); },
                            [&](QFileDialog& dialog) { WindowTest::chooseFile(dialog, file); });
  }
  /// Drags a control point 5 mm away from the middle, parallel to the screen; returns which.
  int dragPointOutwards() {
    const int point = visiblePoint();
    EXPECT_GE(point, 0);
    const Eigen::Vector3d place = editor().solid()->controlPoints()[point];
    const QPoint from = pixelOf(place);
    const QPoint out = from - view().rect().center();
    // Length of a pixel at the point's depth.
    const Eigen::Vector2d pixel(from.x(), from.y());
    const Eigen::Vector3d shifted =
        view().viewport().inViewPlane(pixel + Eigen::Vector2d(out.x(), out.y()), place);
    const double scale = 5.0 / (shifted - place).norm();
    drag(from, from + QPoint(static_cast<int>(std::lround(scale * out.x())),
                             static_cast<int>(std::lround(scale * out.y()))));
    EXPECT_NEAR((editor().solid()->controlPoints()[point] - place).norm(), 5.0, 0.3);
    return point;
  }
};

TEST_F(RecordedSession, EndsWithTheSameDocumentAfterReopening) {
  chooseFile(Qt::Key_O, Qt::ControlModifier, kSphere);
  ASSERT_EQ(editor().project().name, "sphere");
  waitForModel();
  const auto first = editor().model();
  const std::string opened = text();

  const int point = dragPointOutwards();
  const Eigen::Vector3d moved = editor().solid()->controlPoints()[point];
  // The handle is found at the drawn position of the net.
  const QPoint at = pixelOf(moved);
  EXPECT_EQ(view().viewport().controlPointAt({at.x(), at.y()}), point);
  keepPicture("session-1-dragged");
  waitForModel();
  EXPECT_NE(editor().model(), first);
  const std::string dragged = text();
  press(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(text(), opened);
  press(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(text(), dragged);

  const std::size_t points = editor().solid()->controlPoints().size();
  press(Qt::Key_K);
  const QPoint middle = view().rect().center();
  moveTo(middle + QPoint(-40, 30));
  keepPicture("session-2-knot");
  QTest::mouseClick(&view(), Qt::LeftButton, {}, middle + QPoint(-40, 30));
  EXPECT_GT(editor().solid()->controlPoints().size(), points);

  press(Qt::Key_P);
  QComboBox* way = nullptr;
  ASSERT_TRUE(QTest::qWaitFor([&] {
    way = find<QComboBox>("paintWay");
    return way && way->isVisible();
  }));
  QTest::keyClick(way, Qt::Key_Down);
  const std::size_t supports = editor().project().supports.size();
  drag(middle - QPoint(90, 60), middle + QPoint(70, -60));
  ASSERT_EQ(editor().project().supports.size(), supports + 1);
  EXPECT_TRUE(std::holds_alternative<modeling::Stroke>(
      editor().project().supports.back().where.parts.front()));
  waitForModel();
  keepPicture("session-3-painted");

  const QString file = folder_.filePath("worked.json");
  chooseFile(Qt::Key_S, Qt::ControlModifier | Qt::ShiftModifier, file);
  EXPECT_EQ(editor().fileName(), file);
  EXPECT_FALSE(window_->isWindowModified());
  const std::string saved = text();
  ASSERT_TRUE(window_->close());
  restart();
  chooseFile(Qt::Key_O, Qt::ControlModifier, file);
  EXPECT_EQ(text(), saved);
  waitForModel();
  keepPicture("session-4-reopened");
}

}  // namespace
}  // namespace palpa::gui
