#pragma once

#include <QAction>
#include <QKeySequence>
#include <QMainWindow>
#include <QMenu>
#include <QToolBar>
#include <vector>

namespace palpa::gui {

/// Enables an action, or disables it with the obstacle as its tool tip.
void setPossible(QAction* action, const QString& obstacle);

/// Menus and tool bars, filled by the parts of the window. Menus appear in the order of the
/// members.
class Menus {
 public:
  explicit Menus(QMainWindow& window);

  std::vector<QMenu*> all;  ///< all menus, in their order
  QMenu* file;
  QMenu* edit;
  QMenu* select;
  QMenu* solid;
  QMenu* conditions;  ///< supports, loads, touches, material, mesh
  QMenu* simulate;
  QMenu* view;
  QMenu* help;
  QToolBar* bar;    ///< top: files, history, modes, views
  QToolBar* tools;  ///< left: a button for each tool

  /// Separator in the bar before the views; modes are inserted before it.
  QAction* views = nullptr;

  struct Item {
    const char* icon;  ///< of resources/icons; null for none
    QString text;      ///< with & before the letter of the menu
    QKeySequence keys{};
    QString tip{};  ///< sentence for tool tip and status bar
  };

  /// Adds an action to a menu that calls `work` in the context of `owner`. Its tool tip shows the
  /// tip (or the text) and the shortcut. Its objectName is the text without "&" and "…".
  template <class Owner, class Work>
  QAction* add(QMenu* menu, const Item& item, Owner* owner, Work work) {
    QAction* action = make(menu, item);
    QObject::connect(action, &QAction::triggered, owner, std::move(work));
    return action;
  }

  /// Adds a checkable action; `work` receives its state. Does not call `work` for `isOn`.
  template <class Owner, class Work>
  QAction* addToggle(QMenu* menu, const Item& item, bool isOn, Owner* owner, Work work) {
    QAction* action = make(menu, item);
    action->setCheckable(true);
    action->setChecked(isOn);
    QObject::connect(action, &QAction::toggled, owner, std::move(work));
    return action;
  }

 private:
  QMenu* addMenu(QMainWindow& window, const QString& title);
  QAction* make(QMenu* menu, const Item& item);
};

}  // namespace palpa::gui
