#include <QDockWidget>
#include <QFile>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QToolBar>
#include <algorithm>
#include <set>

#include "app/gui/base/appearance.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

using WindowParts = WindowTest;

QString guidePage(const char* name) {
  QFile file(QStringLiteral(PALPA_PROJECTS "/../docs/guide/") + name);
  EXPECT_TRUE(file.open(QIODevice::ReadOnly)) << name;
  return QString::fromUtf8(file.readAll());
}

// Fails for a panel that is not added by DockList::add() or not described in the guide.
TEST_F(WindowParts, EveryPanelIsInMenuLayoutAndGuide) {
  const QString guide = guidePage("window.md");
  const QList<QDockWidget*> panels = window_->findChildren<QDockWidget*>();
  ASSERT_GE(panels.size(), 5);
  std::set<QString> names;
  for (QDockWidget* panel : panels) panel->close();
  action("Reset layout")->trigger();
  for (QDockWidget* panel : panels) {
    const std::string title = panel->windowTitle().toStdString();
    QAction* toggle = panel->toggleViewAction();
    EXPECT_FALSE(title.empty()) << panel->objectName().toStdString();
    EXPECT_FALSE(panel->objectName().isEmpty()) << title;
    EXPECT_TRUE(names.insert(panel->objectName()).second) << title;
    EXPECT_EQ(toggle->associatedObjects().size(), 1) << title;
    EXPECT_TRUE(toggle->isChecked()) << title;
    EXPECT_EQ(window_->dockWidgetArea(panel), Qt::RightDockWidgetArea) << title;
    EXPECT_TRUE(guide.contains("*" + panel->windowTitle() + "*")) << title;
  }
}

// Fails for a tool without icon, key, tip or hint, or without "*name* (key)" in the guide.
TEST_F(WindowParts, EveryToolIsCompleteAndInTheGuide) {
  const QString guide =
      guidePage("modelling.md") + guidePage("supports-and-loads.md") + guidePage("simulate.md");
  for (const char* mode : {"Model", "Simulate"}) {
    action(mode)->trigger();
    std::set<QString> keys;
    int count = 0;
    for (QAction* tool : find<QToolBar>("tools")->actions()) {
      if (!tool->isVisible()) continue;
      ++count;
      const std::string name = tool->objectName().toStdString();
      const QString key = tool->shortcut().toString();
      EXPECT_FALSE(tool->icon().isNull()) << name;
      EXPECT_FALSE(key.isEmpty()) << name;
      EXPECT_TRUE(keys.insert(key).second) << name;
      EXPECT_NE(tool->statusTip(), tool->objectName());
      tool->trigger();
      EXPECT_EQ(window_->tools().activeTitle(), tool->objectName());
      EXPECT_FALSE(window_->tools().active().hint().isEmpty()) << name;
      EXPECT_TRUE(guide.contains(tool->objectName() + "* (" + key + ")") ||
                  guide.contains(tool->objectName() + "** (" + key + ")"))
          << name;
    }
    EXPECT_GE(count, 4) << mode;
  }
}

TEST_F(WindowParts, AnIconWithoutRoomIsEmpty) {
  static int warnings;
  warnings = 0;
  const QtMessageHandler former = qInstallMessageHandler(
      [](QtMsgType, const QMessageLogContext&, const QString&) { ++warnings; });
  EXPECT_TRUE(icon("help").pixmap(QSize(0, 20)).isNull());
  EXPECT_FALSE(icon("help").pixmap(QSize(20, 20)).isNull());
  qInstallMessageHandler(former);
  EXPECT_EQ(warnings, 0);
}

TEST_F(WindowParts, EveryQuantityHasUnits) {
  for (const QuantityInfo& quantity : quantities()) {
    ASSERT_NE(quantity.key, nullptr);
    ASSERT_FALSE(quantity.units.empty()) << quantity.key;
    EXPECT_EQ(quantity.label.isEmpty(), quantity.units.size() == 1) << quantity.key;
  }
}

// At the usual width of 1280 px, in which the guide shows the window.
TEST_F(WindowParts, NoPanelScrollsSideways) {
  ASSERT_TRUE(window_->openFile(PALPA_PROJECTS "/gripper-finger.json"));
  window_->resize(1280, 800);
  action("Reset layout")->trigger();
  for (QDockWidget* panel : window_->findChildren<QDockWidget*>()) {
    panel->raise();
    QTest::qWait(30);
    const std::string name = panel->objectName().toStdString();
    if (const auto* area = qobject_cast<QScrollArea*>(panel->widget())) {
      EXPECT_EQ(area->horizontalScrollBar()->maximum(), 0) << name;
    }
    for (const auto* button : panel->findChildren<QPushButton*>()) {
      if (!button->isVisible()) continue;
      EXPECT_GE(button->width(), button->fontMetrics().horizontalAdvance(button->text()))
          << name << ": " << button->text().toStdString();
    }
  }
}

TEST_F(WindowParts, MessagesFollowTheTheme) {
  window_->messages().showError("An error that stays open");
  QTest::qWait(30);
  // The brightest pixel of the picture: nearly white in the dark theme.
  const auto brightest = [this] {
    const auto* picture = window_->messages().findChild<QLabel*>("picture");
    const QImage image = picture->pixmap().toImage();
    int most = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x)
        if (qAlpha(image.pixel(x, y)) == 255) most = std::max(most, qGray(image.pixel(x, y)));
    return most;
  };
  applyTheme(*qApp, Theme::kLight);
  QTest::qWait(30);
  EXPECT_LT(brightest(), 80);
  applyTheme(*qApp, Theme::kDark);
  QTest::qWait(30);
  EXPECT_GT(brightest(), 180);
  keepPicture("message-in-the-dark-theme");
  applyTheme(*qApp, Theme::kLight);
}

}  // namespace
}  // namespace palpa::gui
