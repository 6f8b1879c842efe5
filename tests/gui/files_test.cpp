#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>
#include <thread>

#include "app/gui/base/background_job.h"
#include "app/gui/base/progress_dialog.h"
#include "modeling/project/autosave.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

using Files = WindowTest;

TEST_F(Files, AJobCanBeCancelledWhileTheWindowLives) {
  std::optional<int> result = 1;
  withDialog<ProgressDialog>(
      [&] {
        result = runInBackground(*window_, "Working", [](const Job& job) {
          for (;;) {
            job.throwIfCancelled();
            job.report(Phase::kMesh, 0.4);
            std::this_thread::yield();
          }
          return 2;
        });
      },
      [&](ProgressDialog& dialog) {
        EXPECT_TRUE(isBackgroundJobRunning());
        keepPicture("progress", &dialog);
        dialog.findChild<QPushButton*>("cancel")->click();
        dialog.hide();
      });
  EXPECT_FALSE(result);
  EXPECT_FALSE(isBackgroundJobRunning());
}

TEST_F(Files, WhatAJobThrowsReachesTheCaller) {
  EXPECT_THROW(runInBackground(*window_, "Working",
                               [](const Job&) -> int { throw std::runtime_error("no"); }),
               std::runtime_error);
}

TEST_F(Files, ErrorsStayAndAnUnknownEndingIsSaid) {
  EXPECT_FALSE(window_->openFile("/tmp/picture.gif"));
  EXPECT_FALSE(window_->openFile("/no/such/file.json"));
  ASSERT_EQ(window_->messages().messages().size(), 2);
  EXPECT_TRUE(window_->messages().messages()[0].contains(".step"));
  keepPicture("messages");
  window_->messages().findChild<QAbstractButton*>("close")->click();
  EXPECT_EQ(window_->messages().messages().size(), 1);
}

/// Counts the layout requests of a widget.
class LayoutCounter : public QObject {
 public:
  bool eventFilter(QObject*, QEvent* event) override {
    if (event->type() == QEvent::LayoutRequest) ++count;
    return false;
  }
  int count = 0;
};

TEST_F(Files, ShownMessagesTakeNoTime) {
  EXPECT_FALSE(window_->openFile("/no/such/file.json"));
  QTest::qWait(200);
  LayoutCounter counter;
  window_->messages().installEventFilter(&counter);
  QTest::qWait(300);
  EXPECT_LT(counter.count, 5);
}

TEST_F(Files, AnExportedSolidIsImportedAgain) {
  ASSERT_TRUE(window_->openFile(kSphere));
  const auto points = editor().solid()->controlPoints();
  const QString step = folder_.filePath("ball.step"), stl = folder_.filePath("ball.stl");
  ASSERT_TRUE(editor().exportFile(step, ExportedSurface::kDrawnSurface));
  ASSERT_TRUE(editor().exportFile(stl, ExportedSurface::kDrawnSurface));
  ASSERT_TRUE(window_->openFile(step));
  EXPECT_EQ(editor().solid()->controlPoints().size(), points.size());
  ASSERT_TRUE(window_->openFile(stl));
  EXPECT_FALSE(editor().solid());
  EXPECT_EQ(window_->settings().recentFiles().front(), stl);
}

TEST_F(Files, APictureHasTheSizeAskedFor) {
  const QString file = folder_.filePath("view.png");
  view().writePicture(file.toStdString(), {900, 500});
  const QImage picture(file);
  EXPECT_EQ(picture.size(), QSize(900, 500));
  EXPECT_NE(picture.pixel(450, 250), picture.pixel(3, 3));
}

TEST_F(Files, EditsAreNotLostWithoutAnAnswer) {
  ASSERT_TRUE(window_->openFile(kSphere));
  editor().perform(modeling::RenameProject{"other"});
  withDialog<QMessageBox>([&] { window_->close(); },
                          [&](QMessageBox& question) {
                            EXPECT_TRUE(question.text().contains("sphere.json"));
                            question.button(QMessageBox::Cancel)->click();
                          });
  EXPECT_TRUE(window_->isVisible());
}

}  // namespace
}  // namespace palpa::gui
