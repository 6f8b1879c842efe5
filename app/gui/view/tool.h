#pragma once

#include <QCursor>
#include <QKeyEvent>
#include <QObject>
#include <QString>

#include "app/gui/view/pointer_event.h"

namespace palpa::gui {

/// One way of using the pointer in the view: a state of the window. The view hands its events to
/// the active tool first; what the tool does not take (returns false) navigates.
class Tool : public QObject {
  Q_OBJECT

 public:
  virtual void activate() {}
  /// Ends everything begun; also called before the tool changes.
  virtual void deactivate() { cancel(); }

  /// Also of the right button, which pans when the tool does not take it.
  virtual bool press(const PointerEvent&) { return false; }
  virtual bool move(const PointerEvent&) { return false; }
  virtual bool release(const PointerEvent&) { return false; }
  virtual bool doubleClick(const PointerEvent&) { return false; }
  /// The wheel was turned by so many notches, away from the person when positive.
  virtual bool wheel(const PointerEvent&, double /*notches*/) { return false; }
  virtual void leave() {}
  virtual bool key(QKeyEvent*) { return false; }
  /// Would key() take this one now? Such keys do not reach the shortcuts of the menus.
  virtual bool wantsKey(const QKeyEvent&) const { return false; }

  /// Undoes what was begun (Escape). False when there was nothing to cancel.
  virtual bool cancel() { return false; }

  virtual QCursor cursor() const { return Qt::ArrowCursor; }
  /// What the status bar says while the tool is active.
  virtual QString hint() const = 0;
  /// What can be set for the tool, for the Properties dock: a new widget, owned by `parent`, each
  /// time the tool becomes active. Null when there is nothing.
  virtual QWidget* makeOptions(QWidget* /*parent*/) { return nullptr; }

 Q_SIGNALS:
  /// hint() changed.
  void changed();
};

}  // namespace palpa::gui
