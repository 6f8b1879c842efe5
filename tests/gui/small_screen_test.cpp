#include <QAbstractButton>
#include <QDialog>
#include <QDockWidget>
#include <QFileDialog>
#include <QLabel>
#include <QMessageBox>
#include <QScreen>
#include <QStatusBar>
#include <QToolBar>

#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

// A screen of 1600 x 1000 with scale factor 2, less the title bar of the window.
constexpr QSize kSmall{800, 464};

using SmallScreen = WindowTest;

std::string sizeText(const QSize& size) {
  return std::to_string(size.width()) + " x " + std::to_string(size.height());
}

/// Texts of labels, buttons and boxes that are wider than their widget.
std::string cutTexts(const QWidget& dialog) {
  std::string cut;
  const auto check = [&](const QWidget* each, const QString& text, int needed) {
    if (each->isVisible() && !text.isEmpty() && each->width() < needed)
      cut += text.toStdString() + "; ";
  };
  for (const auto* label : dialog.findChildren<QLabel*>())
    if (!label->wordWrap() && label->pixmap().isNull())
      check(label, label->text(), label->sizeHint().width());
  for (const auto* button : dialog.findChildren<QAbstractButton*>())
    if (!button->inherits("QToolButton")) check(button, button->text(), button->sizeHint().width());
  return cut;
}

TEST_F(SmallScreen, TheWindowFitsInBothModes) {
  ASSERT_TRUE(window_->openFile(PALPA_PROJECTS "/gripper-finger.json"));
  waitForModel();
  for (const char* mode : {"Model", "Simulate"}) {
    action(mode)->trigger();
    for (QAction* tool : find<QToolBar>("tools")->actions()) {
      if (!tool->isVisible()) continue;
      tool->trigger();
      QTest::qWait(20);
      const QSize least = window_->minimumSizeHint();
      EXPECT_LE(least.width(), kSmall.width()) << mode << tool->objectName().toStdString();
      EXPECT_LE(least.height(), kSmall.height()) << mode << tool->objectName().toStdString();
    }
    window_->resize(kSmall);
    QTest::qWait(50);
    EXPECT_EQ(window_->size(), kSmall) << mode << ": " << sizeText(window_->size());
    EXPECT_GE(window_->statusBar()->visibleRegion().boundingRect().height(), 16) << mode;
    EXPECT_GE(view().width(), 320) << mode;
    keepPicture(QString("small-%1").arg(mode));
  }
  // Also with every panel in front once.
  for (QDockWidget* panel : window_->findChildren<QDockWidget*>()) {
    panel->raise();
    QTest::qWait(20);
    EXPECT_LE(window_->minimumSizeHint().height(), kSmall.height())
        << panel->objectName().toStdString();
  }
}

TEST_F(SmallScreen, ALargeDialogOpensNoLargerThanTheScreen) {
  QDialog dialog(window_.get());
  dialog.resize(5000, 5000);
  dialog.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&dialog));
  const QSize screen = dialog.screen()->availableSize();
  EXPECT_LE(dialog.width(), screen.width());
  EXPECT_LE(dialog.height(), screen.height());
}

// Every menu entry with "…" opens a dialog.
TEST_F(SmallScreen, EveryDialogFits) {
  ASSERT_TRUE(window_->openFile(kSphere));
  waitForModel();
  editor().select(Selection::ofPatches({0}));
  int dialogs = 0;
  for (QAction* each : window_->findChildren<QAction*>()) {
    if (!each->text().endsWith(QStringLiteral("…")) || !each->isEnabled() || each->menu()) continue;
    QSize least, size;
    QString name;
    std::string cut;
    QTimer poll;
    QObject::connect(&poll, &QTimer::timeout, [&] {
      QWidget* modal = QApplication::activeModalWidget();
      if (!modal || !modal->isVisible()) return;
      if (!qobject_cast<QFileDialog*>(modal) && name.isEmpty()) {
        name = modal->objectName() + " " + modal->windowTitle();
        least = modal->minimumSizeHint();
        size = modal->size();
        cut = cutTexts(*modal);
        const QString file =
            QString("dialog-%1").arg(each->objectName()).toLower().replace(' ', '-');
        keepPicture(file, modal);
        if (qEnvironmentVariableIsSet("PALPA_PICTURES")) {
          window_->settings().setTheme(Theme::kDark);
          keepPicture(file + "-dark", modal);
          window_->settings().setTheme(Theme::kLight);
        }
      }
      modal->close();
    });
    poll.start(20);
    each->trigger();
    if (name.isEmpty()) continue;  // a file dialog, or a message in the window
    ++dialogs;
    EXPECT_LE(least.width(), kSmall.width()) << name.toStdString() << ' ' << sizeText(least);
    EXPECT_LE(least.height(), kSmall.height()) << name.toStdString() << ' ' << sizeText(least);
    EXPECT_EQ(cut, "") << name.toStdString();
    QApplication::setActiveWindow(window_.get());
  }
  EXPECT_GE(dialogs, 8);
}

}  // namespace
}  // namespace palpa::gui
