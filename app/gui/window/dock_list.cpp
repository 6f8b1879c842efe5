#include "app/gui/window/dock_list.h"

#include <QScrollArea>
#include <algorithm>

namespace palpa::gui {
namespace {

constexpr int kPanelWidth = 340;  // px: leaves the view almost three quarters of 1280
constexpr int kMinWidth = 300, kMinHeight = 80;  // px of a panel's content
constexpr int kUpperPercent = 45;   // of the window's height; with this share, supports, loads and
constexpr int kForcesPercent = 60;  // the same in Simulate mode, where the forces are above
constexpr int kLowerPercent = 55;   // touches show without scrolling in a window of 1280 x 800

/// Lets a panel that does not scroll by itself scroll in a low window, which otherwise would be
/// higher than the screen.
void scrollWhereLow(QDockWidget& dock) {
  QWidget* content = dock.widget();
  if (qobject_cast<QAbstractScrollArea*>(content)) return;
  auto* scroll = new QScrollArea(&dock);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidgetResizable(true);
  scroll->setMinimumSize(std::min(content->minimumSizeHint().width(), kMinWidth), kMinHeight);
  dock.setWidget(scroll);
  scroll->setWidget(content);
}

}  // namespace

DockList::DockList(QMainWindow& window, QMenu& viewMenu) : window_(window), viewMenu_(viewMenu) {
  window.setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
}

DockList::~DockList() {
  for (const Panel& panel : panels_) delete panel.dock;
}

void DockList::append(QDockWidget* dock, Stack stack) {
  scrollWhereLow(*dock);
  panels_.push_back({dock, stack});
  viewMenu_.addAction(dock->toggleViewAction());
}

void DockList::layOut() {
  for (const Panel& panel : panels_) {
    window_.removeDockWidget(panel.dock);
    panel.dock->setFloating(false);
  }
  QList<QDockWidget*> fronts;
  for (const Stack stack : {Stack::kUpper, Stack::kLower}) {
    QDockWidget* last = nullptr;
    for (const Panel& panel : panels_) {
      if (panel.stack != stack) continue;
      if (last) {
        window_.tabifyDockWidget(last, panel.dock);
      } else {
        window_.addDockWidget(Qt::RightDockWidgetArea, panel.dock);
        fronts << panel.dock;
      }
      last = panel.dock;
    }
  }
  for (const Panel& panel : panels_) panel.dock->show();
  for (QDockWidget* front : fronts) front->raise();
  window_.resizeDocks(
      fronts, {window_.height() * kUpperPercent / 100, window_.height() * kLowerPercent / 100},
      Qt::Vertical);
  window_.resizeDocks({fronts.front()}, {kPanelWidth}, Qt::Horizontal);
}

void DockList::exchangeHeights(bool simulates) {
  const auto frontOf = [this](Stack stack) -> QDockWidget* {
    for (const Panel& panel : panels_)
      if (panel.stack == stack && !panel.dock->isFloating() &&
          !panel.dock->visibleRegion().isEmpty())
        return panel.dock;
    return nullptr;
  };
  QDockWidget *upper = frontOf(Stack::kUpper), *lower = frontOf(Stack::kLower);
  if (!upper || !lower) return;
  heights_[simulates ? 0 : 1] = {upper->height(), lower->height()};
  QList<int>& wanted = heights_[simulates ? 1 : 0];
  if (wanted.isEmpty()) {
    const int both = upper->height() + lower->height();
    wanted = {both * kForcesPercent / 100, both * (100 - kForcesPercent) / 100};
  }
  window_.resizeDocks({upper, lower}, wanted, Qt::Vertical);
}

void bringToFront(QDockWidget& dock) {
  dock.show();
  dock.raise();
}

}  // namespace palpa::gui
