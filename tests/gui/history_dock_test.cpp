#include <QDockWidget>
#include <QListWidget>

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
  EXPECT_NE(steps().item(2)->foreground(), steps().item(1)->foreground());
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
