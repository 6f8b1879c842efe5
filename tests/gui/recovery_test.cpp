#include <QComboBox>
#include <QDateTime>
#include <QDir>
#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>
#include <QRegularExpression>
#include <QTreeWidget>

#include "app/gui/dialogs/recovery_dialog.h"
#include "app/gui/dialogs/welcome_dialog.h"
#include "modeling/project/project_file.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

/// Fixture with snapshots of a crashed program.
class Recovery : public WindowTest {
 protected:
  QDir snapshotFolder() const { return folder_.filePath("palpa/autosave"); }
  QStringList snapshotFiles() const { return snapshotFolder().entryList(QDir::Files); }

  static modeling::Project project(const std::string& name) {
    modeling::Project made = modeling::readProject(kSphere.toStdString());
    made.name = name;
    return made;
  }

  /// Leaves a snapshot of a program that no longer runs: its start time belongs to no present
  /// process.
  void crash(const modeling::Project& lost, const QString& original = {}) {
    modeling::Autosave(modeling::defaultAutosaveFolder()).write(lost, original.toStdString(), 7);
    for (const QFileInfo& each : snapshotFolder().entryInfoList(QDir::Files)) {
      QFile file(each.filePath());
      ASSERT_TRUE(file.open(QIODevice::ReadWrite));
      QString content = QString::fromUtf8(file.readAll());
      content.replace(QRegularExpression("\"start\": \\d+"), "\"start\": 1");
      file.resize(0);
      file.write(content.toUtf8());
    }
  }

  /// Calls MainWindow::begin() and runs `act` on the dialog.
  void begin(const std::function<void(RecoveryDialog&)>& act) {
    bool isAnswered = false;
    withDialog<RecoveryDialog>(
        [&] {
          window_->begin({});
          EXPECT_TRUE(QTest::qWaitFor([&] { return isAnswered; }, 10000));
        },
        [&](RecoveryDialog& dialog) {
          act(dialog);
          isAnswered = true;
        });
  }

  static void click(QDialog& dialog, const QString& button) {
    QTest::mouseClick(dialog.findChild<QPushButton*>(button), Qt::LeftButton);
  }
};

TEST_F(Recovery, TheEditsComeBackAndAreSavedToTheirFile) {
  const QString file = folder_.filePath("ball.json");
  modeling::writeProject(project("as it was saved"), file.toStdString());
  const modeling::Project lost = project("as it was edited");
  crash(lost, file);
  begin([&](RecoveryDialog& dialog) {
    keepPicture("recovery", &dialog);
    click(dialog, "recover");
  });
  EXPECT_EQ(text(), modeling::toJson(lost));
  EXPECT_TRUE(window_->isWindowModified());
  EXPECT_EQ(editor().fileName(), file);
  EXPECT_EQ(modeling::readProject(file.toStdString()).name, "as it was saved");
  // The snapshot of the new session replaces the old one.
  EXPECT_EQ(snapshotFiles().size(), 1);
  EXPECT_TRUE(modeling::findRecoverable(modeling::defaultAutosaveFolder()).snapshots.empty());
  QApplication::setActiveWindow(window_.get());
  QTest::keyClick(window_.get(), Qt::Key_S, Qt::ControlModifier);
  EXPECT_FALSE(window_->isWindowModified());
  EXPECT_EQ(modeling::readProject(file.toStdString()).name, "as it was edited");
  EXPECT_TRUE(snapshotFiles().empty());
}

TEST_F(Recovery, LaterKeepsThemForTheNextStart) {
  crash(project("one"));
  const std::string before = text();
  begin([&](RecoveryDialog& dialog) { click(dialog, "later"); });
  EXPECT_EQ(text(), before);
  EXPECT_EQ(snapshotFiles().size(), 1);
  restart();
  begin([&](RecoveryDialog& dialog) { QTest::keyClick(&dialog, Qt::Key_Escape); });
  EXPECT_EQ(snapshotFiles().size(), 1);
}

TEST_F(Recovery, OldSnapshotsOfWhatWasSavedLaterGo) {
  const QString file = folder_.filePath("ball.json");
  crash(project("month-old"), file);
  for (const QFileInfo& each : snapshotFolder().entryInfoList(QDir::Files)) {
    QFile snapshot(each.filePath());
    ASSERT_TRUE(snapshot.open(QIODevice::ReadWrite));
    const QString content = QString::fromUtf8(snapshot.readAll());
    const qint64 then = QDateTime::currentDateTime().addDays(-40).toMSecsSinceEpoch() * 1000;
    snapshot.resize(0);
    snapshot.write(
        QString(content)
            .replace(QRegularExpression("\"time_us\": \\d+"), QString("\"time_us\": %1").arg(then))
            .toUtf8());
  }
  crash(project("of today"), folder_.filePath("cube.json"));
  ASSERT_EQ(snapshotFiles().size(), 2);
  for (const char* name : {"ball.json", "cube.json"}) {
    modeling::writeProject(project("saved"), folder_.filePath(name).toStdString());
    std::filesystem::last_write_time(
        folder_.filePath(name).toStdString(),
        std::filesystem::file_time_type::clock::now() + std::chrono::seconds(5));
  }
  window_->begin({});
  // Today's snapshot stays: another program may have written its file.
  EXPECT_TRUE(QTest::qWaitFor([&] { return snapshotFiles().size() == 1; }, 10000));
  const auto left = modeling::findRecoverable(modeling::defaultAutosaveFolder());
  ASSERT_EQ(left.outdated.size(), 1u);
  EXPECT_EQ(left.outdated.front().projectName, "of today");
}

TEST_F(Recovery, DiscardingAsksAndThenRemoves) {
  crash(project("one"));
  crash(project("two"));
  begin([&](RecoveryDialog& dialog) {
    auto* list = dialog.findChild<QTreeWidget*>("snapshots");
    EXPECT_EQ(list->topLevelItemCount(), 2);
    EXPECT_EQ(list->topLevelItem(0)->text(0), "two");  // newest first
    const auto discard = [&](QMessageBox::StandardButton answer) {
      withDialog<QMessageBox>([&] { click(dialog, "discard"); },
                              [&](QMessageBox& question) {
                                EXPECT_TRUE(question.text().contains("two"));
                                QTest::mouseClick(question.button(answer), Qt::LeftButton);
                              });
    };
    discard(QMessageBox::No);
    EXPECT_EQ(snapshotFiles().size(), 2);
    discard(QMessageBox::Yes);
    EXPECT_EQ(snapshotFiles().size(), 1);
    EXPECT_EQ(list->topLevelItemCount(), 1);
    click(dialog, "later");
  });
}

TEST_F(Recovery, TheOthersAreOfferedByTheMenu) {
  crash(project("one"));
  crash(project("two"));
  begin([&](RecoveryDialog& dialog) {
    auto* list = dialog.findChild<QTreeWidget*>("snapshots");
    list->setFocus();
    QTest::keyClick(list, Qt::Key_Down);
    click(dialog, "recover");
  });
  EXPECT_EQ(editor().project().name, "one");
  bool isAnswered = false;
  withDialog<RecoveryDialog>(
      [&] {
        action("Recover")->trigger();
        EXPECT_TRUE(QTest::qWaitFor([&] { return isAnswered; }, 10000));
      },
      [&](RecoveryDialog& dialog) {
        // The recovered project is not saved yet; recovering another one must not lose it.
        withDialog<QMessageBox>(
            [&] { click(dialog, "recover"); },
            [](QMessageBox& question) { question.button(QMessageBox::Cancel)->click(); });
        EXPECT_TRUE(dialog.isVisible());
        EXPECT_EQ(editor().project().name, "one");
        withDialog<QMessageBox>(
            [&] { click(dialog, "recover"); },
            [](QMessageBox& question) { question.button(QMessageBox::Discard)->click(); });
        isAnswered = true;
      });
  EXPECT_EQ(editor().project().name, "two");
  EXPECT_TRUE(window_->isWindowModified());
}

TEST_F(Recovery, ADamagedSnapshotIsNamedAndKept) {
  crash(project("one"));
  const QString name = snapshotFiles().front();
  QFile file(snapshotFolder().filePath(name));
  ASSERT_TRUE(file.resize(file.size() / 2));
  window_->begin({kSphere});
  ASSERT_TRUE(QTest::qWaitFor([&] { return !window_->messages().messages().isEmpty(); }, 10000));
  EXPECT_TRUE(window_->messages().messages().front().contains(name));
  EXPECT_EQ(snapshotFiles(), QStringList{name});
}

TEST_F(Recovery, ItIsSaidThatThereIsNothing) {
  action("Recover")->trigger();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !window_->messages().messages().isEmpty(); }, 10000));
}

TEST_F(Recovery, TheWindowCanCloseWhileSnapshotsAreRead) {
  crash(project("one"));
  const QString name = snapshotFolder().filePath(snapshotFiles().front());
  for (int i = 0; i < 100; ++i)
    QFile::copy(name, snapshotFolder().filePath(QString("%1.palpa-autosave").arg(i)));
  window_->begin({});
  window_.reset();
  EXPECT_EQ(snapshotFiles().size(), 101);
}

TEST_F(Recovery, OnlyTheFirstRunIsWelcomedAndTheWindowKeepsItsPlace) {
  bool isAnswered = false;
  withDialog<WelcomeDialog>(
      [&] {
        window_->begin({});
        EXPECT_TRUE(QTest::qWaitFor([&] { return isAnswered; }, 10000));
      },
      [&](WelcomeDialog& dialog) {
        QTest::keyClick(&dialog, Qt::Key_Escape);
        isAnswered = true;
      });
  window_->resize(1100, 700);
  const QSize size = window_->size();
  window_->close();
  restart();
  EXPECT_EQ(window_->size(), size);
  window_->begin({});
  QTest::qWait(500);
  EXPECT_FALSE(QApplication::activeModalWidget());
}

}  // namespace
}  // namespace palpa::gui
