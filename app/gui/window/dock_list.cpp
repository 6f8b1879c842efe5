#include "app/gui/window/dock_list.h"

namespace palpa::gui {
namespace {

constexpr int kWidth = 340;        // px: leaves the view almost three quarters of 1280
constexpr int kUpperPercent = 44;  // of the window's height; with this share, supports, loads and
constexpr int kLowerPercent = 56;  // touches show without scrolling in a window of 1280 x 800

}  // namespace

DockList::DockList(QMainWindow& window, QMenu& viewMenu) : window_(window), viewMenu_(viewMenu) {
  window.setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
}

DockList::~DockList() {
  for (const Panel& panel : panels_) delete panel.dock;
}

void DockList::append(QDockWidget* dock, Stack stack) {
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
  window_.resizeDocks({fronts.front()}, {kWidth}, Qt::Horizontal);
}

void bringToFront(QDockWidget& dock) {
  dock.show();
  dock.raise();
}

}  // namespace palpa::gui
