#include <QCheckBox>
#include <QDir>
#include <QListWidget>
#include <QMenu>

#include "app/gui/dialogs/welcome_dialog.h"
#include "app/gui/document/thumbnails.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

class Welcome : public WindowTest {
 protected:
  QString save(const QString& project, const QString& as) {
    EXPECT_TRUE(window_->openFile(PALPA_PROJECTS "/" + project));
    QTest::qWait(50);
    const QString file = folder_.filePath(as);
    EXPECT_TRUE(editor().saveAs(file));
    return file;
  }
  void withWelcome(const std::function<void(WelcomeDialog&)>& act) {
    withDialog<WelcomeDialog>([this] { action("Welcome")->trigger(); }, act);
  }
};

TEST_F(Welcome, RecentFilesHavePicturesAndOpenByTheKeyboard) {
  const QString ball = save("sphere.json", "ball.json");
  const QString finger = save("gripper-finger.json", "finger.json");
  EXPECT_FALSE(thumbnailOf(ball).isNull());
  EXPECT_EQ(thumbnailOf(finger).size(), kThumbnailSize);
  EXPECT_NE(thumbnailOf(ball), thumbnailOf(finger));
  ASSERT_TRUE(window_->openFile(kSphere));
  withWelcome([&](WelcomeDialog& dialog) {
    auto* list = dialog.findChild<QListWidget*>("recentFiles");
    ASSERT_TRUE(list);
    EXPECT_EQ(dialog.focusWidget(), list);
    ASSERT_EQ(list->count(), window_->settings().recentFiles().size());
    EXPECT_EQ(list->item(0)->text(), "sphere.json");
    EXPECT_EQ(list->item(1)->text(), "finger.json");
    keepPicture("welcome-recent", &dialog);
    QTest::keyClick(list, Qt::Key_Right);
    QTest::keyClick(list, Qt::Key_Return);
  });
  EXPECT_EQ(editor().fileName(), finger);
}

TEST_F(Welcome, MissingFilesAreShownAndCanBeRemoved) {
  const QString ball = save("sphere.json", "ball.json");
  const QString box = save("box.json", "box.json");
  QFile::remove(box);
  withWelcome([&](WelcomeDialog& dialog) {
    auto* list = dialog.findChild<QListWidget*>("recentFiles");
    EXPECT_TRUE(list->item(0)->text().contains("missing"));
    keepPicture("welcome-missing", &dialog);
    QTest::keyClick(list, Qt::Key_Return);  // cannot be opened
    EXPECT_TRUE(dialog.isVisible());
    const int count = list->count();
    QTest::keyClick(list, Qt::Key_Delete);
    EXPECT_EQ(list->count(), count - 1);
    QTest::keyClick(&dialog, Qt::Key_Escape);
  });
  EXPECT_FALSE(window_->settings().recentFiles().contains(box));
  EXPECT_TRUE(thumbnailOf(box).isNull());
  EXPECT_FALSE(thumbnailOf(ball).isNull());
  EXPECT_EQ(editor().fileName(), box);  // nothing was opened
}

TEST_F(Welcome, APictureShowsTheFileAndNotEditsThatWereDiscarded) {
  const QString ball = save("sphere.json", "ball.json");
  const QImage before = thumbnailOf(ball);
  ASSERT_TRUE(editor().perform(modeling::MovePoints{
      modeling::PointSelection::of({0, 1, 2, 3}), modeling::MoveBy{{0, 0, 30}}, {}}));
  QTest::qWait(50);
  ASSERT_TRUE(window_->openFile(kSphere));  // without saving
  EXPECT_EQ(thumbnailOf(ball), before);
  // The picture follows the view at the time the project is left.
  ASSERT_TRUE(window_->openFile(ball));
  action("Top")->trigger();
  QTest::qWait(50);
  ASSERT_TRUE(window_->openFile(kSphere));
  EXPECT_NE(thumbnailOf(ball), before);
}

TEST_F(Welcome, ClearingTheListRemovesThePictures) {
  const QString ball = save("sphere.json", "ball.json");
  auto* menu = window_->findChild<QMenu*>("recent");
  Q_EMIT menu->aboutToShow();
  window_->findChild<QAction*>("Clear list")->trigger();
  EXPECT_TRUE(thumbnailOf(ball).isNull());
  EXPECT_TRUE(window_->settings().recentFiles().isEmpty());
}

TEST_F(Welcome, AStartWithoutAFileOffersRecentFilesUntilSwitchedOff) {
  save("sphere.json", "ball.json");
  window_->close();
  restart();
  bool isAnswered = false;
  withDialog<WelcomeDialog>(
      [&] {
        window_->begin({});
        EXPECT_TRUE(QTest::qWaitFor([&] { return isAnswered; }, 10000));
      },
      [&](WelcomeDialog& dialog) {
        dialog.findChild<QCheckBox*>("showAtStart")->setChecked(false);
        QTest::keyClick(&dialog, Qt::Key_Escape);
        isAnswered = true;
      });
  window_->close();
  restart();
  window_->begin({});
  QTest::qWait(300);
  EXPECT_FALSE(QApplication::activeModalWidget());
}

}  // namespace
}  // namespace palpa::gui
