#include <QCheckBox>
#include <QFile>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <cmath>

#include "app/gui/base/background_job.h"
#include "app/gui/dialogs/import_profile_dialog.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

class ProfileImport : public WindowTest {
 protected:
  /// A drawing with a large triangle and a closed wave of very many lines, whose fit takes long.
  modeling::ProfileDrawing longDrawing() {
    constexpr int kLines = 4000;
    QString data = "M 0 0 L 390 0 L 390 390 Z M 300 100";
    for (int k = 1; k < kLines; ++k) {
      const double turn = 2 * 3.14159265358979 * k / kLines;
      const double radius = 100 + 5 * std::sin(40 * turn) + 0.05 * std::sin(200 * turn);
      data += QString(" L %1 %2")
                  .arg(200 + radius * std::cos(turn), 0, 'f', 9)
                  .arg(100 + radius * std::sin(turn), 0, 'f', 9);
    }
    const QString name = folder_.filePath("wave.svg");
    QFile file(name);
    EXPECT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"400mm\" height=\"400mm\" "
                "viewBox=\"0 0 400 400\"><path d=\"" +
                data + " Z\"/></svg>")
                   .toUtf8());
    file.close();
    return modeling::readProfileDrawing(name.toStdString());
  }
};

TEST_F(ProfileImport, ALongFitIsCancelled) {
  ImportProfileDialog dialog(window_->settings(), modeling::SketchUse::kExtrude, longDrawing(),
                             window_.get());
  dialog.show();
  auto* paths = dialog.findChild<QListWidget*>("paths");
  auto* result = dialog.findChild<QLabel*>("result");
  ASSERT_EQ(paths->count(), 2);
  EXPECT_TRUE(result->text().contains("control points"));
  dialog.findChild<QCheckBox*>("smooths")->setChecked(true);
  // The window lives while the spline is fitted; Cancel ends the fit.
  bool wasRunning = false;
  QTimer poll;
  QObject::connect(&poll, &QTimer::timeout, &dialog, [&] {
    wasRunning = wasRunning || isBackgroundJobRunning();
    cancelBackgroundJob();
  });
  poll.start(1);
  paths->setCurrentRow(1);
  EXPECT_TRUE(wasRunning);
  EXPECT_TRUE(result->text().startsWith("The fit was cancelled")) << result->text().toStdString();
  keepPicture("profile-import-cancelled", &dialog);
  dialog.accept();
  EXPECT_TRUE(dialog.isVisible()) << "there is nothing to import";
  // Another curve is fitted as before.
  poll.stop();
  paths->setCurrentRow(0);
  EXPECT_TRUE(result->text().contains("control points"));
  dialog.accept();
  EXPECT_FALSE(dialog.isVisible());
}

}  // namespace
}  // namespace palpa::gui
