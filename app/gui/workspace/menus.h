#pragma once

#include <QAction>
#include <QKeySequence>
#include <QMainWindow>
#include <QMenu>
#include <QToolBar>

namespace palpa::gui {

/// The window's menus and tool bars, for the parts of the window to fill. Menus appear in the order
/// of the members.
class Menus {
 public:
  explicit Menus(QMainWindow& window);

  QMenu* file;
  QMenu* edit;
  QMenu* select;
  QMenu* solid;
  QMenu* conditions;  ///< supports, loads, touches, material, mesh
  QMenu* simulate;    ///< touching
  QMenu* view;
  QMenu* help;
  QToolBar* bar;    ///< top: files, history, modes, views
  QToolBar* tools;  ///< left: one button for each tool

  /// In the bar, where views begin: modes are inserted before it.
  QAction* views = nullptr;

  struct Item {
    const char* icon;  ///< of resources/icons; null for none
    QString text;      ///< with & before the letter of the menu
    QKeySequence keys{};
    QString tip{};  ///< a sentence on what it does, for tool tip and status bar
  };

  /// An action at the end of a menu that calls `work` in the context of `owner`. Its tool tip shows
  /// the tip, or the text, and the shortcut. The action's objectName is the text without "&", "…".
  template <class Owner, class Work>
  QAction* add(QMenu* menu, const Item& item, Owner* owner, Work work) {
    QAction* action = make(menu, item);
    QObject::connect(action, &QAction::triggered, owner, std::move(work));
    return action;
  }

  /// A checkable one; `work` gets whether it is on. Does not call it for `isOn`.
  template <class Owner, class Work>
  QAction* addToggle(QMenu* menu, const Item& item, bool isOn, Owner* owner, Work work) {
    QAction* action = make(menu, item);
    action->setCheckable(true);
    action->setChecked(isOn);
    QObject::connect(action, &QAction::toggled, owner, std::move(work));
    return action;
  }

 private:
  QAction* make(QMenu* menu, const Item& item);
};

}  // namespace palpa::gui
