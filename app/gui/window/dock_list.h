#pragma once

#include <QDockWidget>
#include <QMainWindow>
#include <QMenu>
#include <array>
#include <vector>

namespace palpa::gui {

/// The panels of the window. add() puts a panel into the View menu, the usual layout and the saved
/// layout; the list deletes its panels.
class DockList {
 public:
  /// Stack of tabs at the right side of the window. The first panel of a stack is its front tab.
  enum class Stack { kUpper, kLower };

  DockList(QMainWindow& window, QMenu& viewMenu);
  ~DockList();
  DockList(const DockList&) = delete;
  DockList& operator=(const DockList&) = delete;

  /// The panel needs a title, an object name that no other panel has (the saved layout refers to
  /// it) and the window as its parent.
  template <class Dock>
  Dock* add(Dock* dock, Stack stack) {
    append(dock, stack);
    return dock;
  }

  /// Shows all panels at their usual places.
  void layOut();
  /// On entering (`simulates`) or leaving Simulate mode: remembers the heights of the stacks in the
  /// former mode and restores the last ones of the new mode.
  void exchangeHeights(bool simulates);

 private:
  void append(QDockWidget* dock, Stack stack);

  struct Panel {
    QDockWidget* dock;
    Stack stack;
  };
  QMainWindow& window_;
  QMenu& viewMenu_;
  std::vector<Panel> panels_;
  std::array<QList<int>, 2> heights_;  // of the stacks in Model and Simulate mode; empty: usual
};

/// Shows the panel in front of the other tabs of its stack.
void bringToFront(QDockWidget& dock);

}  // namespace palpa::gui
