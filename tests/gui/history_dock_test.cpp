#include <QDockWidget>
#include <QListWidget>

#include "app/gui/base/appearance.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

class HistoryDock : public WindowTest {
 protected:
  HistoryDock() {
    EXPECT_TRUE(window_->openFile(kSphere));
    window_->findChild<QDockWidget*>("history")->raise();
    for (const char* name : {"one", "two", "three"})
      editor().perform(modeling::RenameProject{name});
    EXPECT_TRUE(QTest::qWaitFor([this] { return steps().count() == 4; }));
  }

  QListWidget& steps() {
    return *window_->findChild<QDockWidget*>("history")->findChild<QListWidget*>("steps");
  }
  bool isBold(int row) { return steps().item(row)->font().bold(); }
};

TEST_F(HistoryDock, AClickGoesToAStep) {
  EXPECT_EQ(steps().item(1)->text(), "Rename project");
  EXPECT_TRUE(isBold(3));
  QTest::mouseClick(steps().viewport(), Qt::LeftButton, {},
                    steps().visualItemRect(steps().item(1)).center());
  EXPECT_EQ(editor().project().name, "one");
  EXPECT_TRUE(QTest::qWaitFor([this] { return isBold(1); }));
  EXPECT_EQ(steps().count(), 4);  // the undone ones stay
  // Undone steps are faint, but readable in both themes.
  const auto contrast = [this](int row) {
    const QRect place = steps().visualItemRect(steps().item(row)).adjusted(40, 2, -2, -2);
    const QImage image = steps().viewport()->grab(place).toImage();
    const int ground = qGray(image.pixel(image.width() - 1, 0));
    int most = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x)
        most = std::max(most, std::abs(qGray(image.pixel(x, y)) - ground));
    return most;
  };
  for (const Theme theme : {Theme::kLight, Theme::kDark}) {
    applyTheme(*qApp, theme);
    QTest::qWait(30);
    EXPECT_GT(contrast(2), 100);
    EXPECT_LT(contrast(2), contrast(0) - 20);
  }
  applyTheme(*qApp, Theme::kLight);
  keepPicture("history-dock");
  editor().perform(modeling::RenameProject{"four"});
  EXPECT_TRUE(QTest::qWaitFor([this] { return steps().count() == 3; }));
}

TEST_F(HistoryDock, IsUsedByKeyboard) {
  steps().setFocus();
  QTest::keyClick(&steps(), Qt::Key_Up);
  QTest::keyClick(&steps(), Qt::Key_Up);
  EXPECT_EQ(editor().project().name, "three");
  QTest::keyClick(&steps(), Qt::Key_Return);
  EXPECT_EQ(editor().project().name, "one");
}

TEST_F(HistoryDock, MarksTheSavedState) {
  EXPECT_TRUE(steps().item(0)->data(Qt::UserRole).toBool());
  ASSERT_TRUE(editor().saveAs(folder_.filePath("ball.json")));
  EXPECT_TRUE(QTest::qWaitFor([this] { return steps().item(3)->data(Qt::UserRole).toBool(); }));
  EXPECT_FALSE(steps().item(0)->data(Qt::UserRole).toBool());
}

}  // namespace
}  // namespace palpa::gui
