#pragma once

#include <QCursor>
#include <QKeyEvent>
#include <QObject>
#include <QString>
#include <vector>

#include "app/gui/view/pointer_event.h"

namespace palpa::gui {

/// A group of rows in the dialog "Keyboard and mouse".
struct KeyHelp {
  struct Row {
    QString action, keys;
    bool operator==(const Row&) const = default;
  };
  QString title;
  std::vector<Row> rows;
};

/// Use of the pointer in the view. The view passes its events to the active tool first; events
/// that the tool does not take (it returns false) navigate.
class Tool : public QObject {
  Q_OBJECT

 public:
  virtual void activate() {}
  /// Aborts the present operation; also called before the tool changes.
  virtual void deactivate() { cancel(); }

  /// Any button; the right one pans if the tool returns false.
  virtual bool press(const PointerEvent&) { return false; }
  virtual bool move(const PointerEvent&) { return false; }
  virtual bool release(const PointerEvent&) { return false; }
  virtual bool doubleClick(const PointerEvent&) { return false; }
  /// Notches of the wheel, positive away from the user.
  virtual bool wheel(const PointerEvent&, double /*notches*/) { return false; }
  virtual void leave() {}
  virtual bool key(QKeyEvent*) { return false; }
  /// True if key() would take this key now. Such keys do not trigger shortcuts of the menus.
  virtual bool wantsKey(const QKeyEvent&) const { return false; }
  /// True if the present operation follows the pointer without a pressed button: then the view cube
  /// does not take the pointer. By default, such operations want Enter, which confirms them.
  virtual bool followsPointer() const {
    return wantsKey(QKeyEvent(QEvent::KeyPress, Qt::Key_Return, Qt::NoModifier));
  }

  /// Aborts the present operation (Escape). False without an operation.
  virtual bool cancel() { return false; }

  virtual QCursor cursor() const { return Qt::ArrowCursor; }
  /// Text of the status bar while the tool is active.
  virtual QString hint() const = 0;
  /// Keys and mouse buttons of the tool. Tools with the same title share one group of the dialog.
  virtual KeyHelp keyHelp() const = 0;
  /// Options for the Properties panel: a new widget, owned by `parent`, each time the tool becomes
  /// active. Null without options.
  virtual QWidget* makeOptions(QWidget* /*parent*/) { return nullptr; }

 Q_SIGNALS:
  /// hint() changed.
  void changed();
};

}  // namespace palpa::gui
