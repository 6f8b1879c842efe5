#include <QDir>
#include <QDropEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QLineEdit>
#include <QMessageBox>
#include <QMimeData>
#include <QPushButton>
#include <QUrl>
#include <thread>

#include "app/gui/base/background_job.h"
#include "app/gui/dialogs/new_solid_dialog.h"
#include "modeling/project/project_file.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

/// Fixture with an unsaved edit of a file.
class Saving : public WindowTest {
 protected:
  void openAndEdit() {
    modeling::writeProject(modeling::readProject(kSphere.toStdString()), file_.toStdString());
    ASSERT_TRUE(window_->openFile(file_));
    edit("edited");
  }
  void edit(const std::string& name) {
    ASSERT_TRUE(editor().perform(modeling::RenameProject{name}));
    ASSERT_TRUE(window_->isWindowModified());
  }
  std::string savedName() const { return modeling::readProject(file_.toStdString()).name; }

  /// Answers the question opened by `act`.
  void answer(const std::function<void()>& act, QMessageBox::StandardButton button) {
    withDialog<QMessageBox>(act, [&](QMessageBox& question) {
      EXPECT_TRUE(question.text().contains("ball.json")) << question.text().toStdString();
      QTest::mouseClick(question.button(button), Qt::LeftButton);
    });
  }

  void drop(const QStringList& files) {
    QMimeData data;
    QList<QUrl> urls;
    for (const QString& file : files) urls << QUrl::fromLocalFile(file);
    data.setUrls(urls);
    QDragEnterEvent enter({200, 200}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(window_.get(), &enter);
    EXPECT_TRUE(enter.isAccepted());
    QDropEvent event({200, 200}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(window_.get(), &event);
    QTest::qWait(20);  // the window asks and reads after the drop has returned
  }

  /// Types a name into the dialog for files and presses Enter.
  const QString file_ = folder_.filePath("ball.json");
};

TEST_F(Saving, ClosingAsks) {
  openAndEdit();
  answer([&] { window_->close(); }, QMessageBox::Cancel);
  EXPECT_TRUE(window_->isVisible());
  EXPECT_EQ(editor().project().name, "edited");
  answer([&] { window_->close(); }, QMessageBox::Discard);
  EXPECT_FALSE(window_->isVisible());
  EXPECT_NE(savedName(), "edited");
}

TEST_F(Saving, ClosingSaves) {
  openAndEdit();
  answer([&] { window_->close(); }, QMessageBox::Save);
  EXPECT_FALSE(window_->isVisible());
  EXPECT_EQ(savedName(), "edited");
}

TEST_F(Saving, OpeningAsks) {
  openAndEdit();
  const auto openRecent = [&] {
    auto* menu = find<QMenu>("recent");
    Q_EMIT menu->aboutToShow();
    menu->findChild<QAction*>(file_)->trigger();
  };
  answer(openRecent, QMessageBox::Cancel);
  EXPECT_EQ(editor().project().name, "edited");
  answer(openRecent, QMessageBox::Save);
  EXPECT_EQ(editor().project().name, "edited");
  EXPECT_FALSE(window_->isWindowModified());
  edit("edited again");
  answer(openRecent, QMessageBox::Discard);
  EXPECT_EQ(editor().project().name, "edited");
}

TEST_F(Saving, ANewSolidAsks) {
  openAndEdit();
  answer([&] { action("New")->trigger(); }, QMessageBox::Cancel);
  withDialog<NewSolidDialog>(
      [&] { answer([&] { action("New")->trigger(); }, QMessageBox::Discard); },
      [](NewSolidDialog& dialog) { dialog.reject(); });
  // Nothing was edited: no question.
  EXPECT_EQ(editor().project().name, "edited");
  EXPECT_TRUE(window_->isWindowModified());
}

TEST_F(Saving, DroppingAsksAndOpensTheFirst) {
  openAndEdit();
  answer([&] { drop({kSphere}); }, QMessageBox::Cancel);
  EXPECT_EQ(editor().project().name, "edited");
  answer([&] { drop({PALPA_PROJECTS "/box.json", kSphere}); }, QMessageBox::Discard);
  EXPECT_TRUE(editor().fileName().endsWith("box.json"));
  ASSERT_FALSE(window_->messages().messages().isEmpty());
  EXPECT_TRUE(window_->messages().messages().front().contains("box.json"));
}

TEST_F(Saving, WhatCannotBeSavedKeepsTheWindowOpen) {
  const QString folder = folder_.filePath("gone");
  ASSERT_TRUE(QDir().mkdir(folder));
  ASSERT_TRUE(window_->openFile(kSphere));
  ASSERT_TRUE(editor().saveAs(folder + "/ball.json"));
  edit("edited");
  ASSERT_TRUE(QDir(folder).removeRecursively());
  answer([&] { window_->close(); }, QMessageBox::Save);
  EXPECT_TRUE(window_->isVisible());
  EXPECT_TRUE(window_->isWindowModified());
  ASSERT_EQ(window_->messages().messages().size(), 1);
  EXPECT_TRUE(window_->messages().messages().front().contains("ball.json"));
  // A folder without write permission.
  EXPECT_FALSE(editor().saveAs("/proc/ball.json"));
  EXPECT_TRUE(window_->isWindowModified());
  EXPECT_EQ(editor().fileName(), folder + "/ball.json");
}

TEST_F(Saving, SavingOverAnotherFileAsks) {
  openAndEdit();
  const QString other = folder_.filePath("other.json");
  modeling::writeProject(modeling::readProject(PALPA_PROJECTS "/box.json"), other.toStdString());
  const auto saveOver = [&](QMessageBox::StandardButton answer) {
    withDialog<QFileDialog>([&] { action("Save as")->trigger(); },
                            [&](QFileDialog& dialog) {
                              withDialog<QMessageBox>(
                                  [&] { chooseFile(dialog, folder_.filePath("other")); },
                                  [&](QMessageBox& question) {
                                    EXPECT_TRUE(question.text().contains("other.json"));
                                    question.button(answer)->click();
                                  });
                              if (dialog.isVisible()) dialog.reject();
                            });
  };
  saveOver(QMessageBox::No);
  EXPECT_NE(modeling::readProject(other.toStdString()).name, "edited");
  EXPECT_TRUE(window_->isWindowModified());
  saveOver(QMessageBox::Yes);
  EXPECT_EQ(modeling::readProject(other.toStdString()).name, "edited");
  EXPECT_EQ(editor().fileName(), other);
  EXPECT_EQ(window_->settings().recentFiles().front(), other);
}

TEST_F(Saving, ClosingEndsAJobFirst) {
  QTimer::singleShot(30, window_.get(), &QWidget::close);
  const auto result = runInBackground(*window_, "Working", [&](const Job& job) {
    while (!job.stop.stop_requested()) std::this_thread::yield();
    return 1;
  });
  EXPECT_FALSE(result);
  EXPECT_TRUE(QTest::qWaitFor([&] { return !window_->isVisible(); }));
}

TEST_F(Saving, ClosingDuringAJobAsksInTheFirstTurnAfterIt) {
  openAndEdit();
  QTimer::singleShot(30, window_.get(), &QWidget::close);
  runInBackground(*window_, "Working", [&](const Job& job) {
    while (!job.stop.stop_requested()) std::this_thread::yield();
    return 1;
  });
  // Not later, when nobody expects a question any more.
  int questions = 0;
  QTimer::singleShot(0, window_.get(), [&questions] {
    auto* question = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    if (!question) return;
    ++questions;
    question->button(QMessageBox::Cancel)->click();
  });
  QCoreApplication::processEvents();
  EXPECT_EQ(questions, 1);
  EXPECT_TRUE(window_->isVisible());
  EXPECT_TRUE(window_->isWindowModified());
}

TEST_F(Saving, ClosingDoesNotWaitForTheModel) {
  ASSERT_TRUE(window_->openFile(PALPA_PROJECTS "/gripper-finger.json"));
  EXPECT_EQ(editor().rebuildStatus().state, app::RebuildStatus::State::kBuilding);
  EXPECT_TRUE(window_->close());
  window_.reset();
}

}  // namespace
}  // namespace palpa::gui
