#include "app/gui/window/keyboard_focus.h"

#include <QAbstractItemView>
#include <QAbstractSpinBox>
#include <QApplication>
#include <QDockWidget>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QStatusBar>
#include <QToolBar>

#include "app/gui/widgets/field_input.h"

namespace palpa::gui {
namespace {

bool isPlainKey(const QKeyEvent& event) {
  return (event.modifiers() & ~Qt::KeypadModifier) == 0;
}

/// Editor of a name in a list, which handles Enter and Escape itself.
bool isInList(const QWidget& field) {
  const QWidget* parent = field.parentWidget();
  return parent && qobject_cast<const QAbstractItemView*>(parent->parentWidget());
}

/// True if the entry in a field was invalid or the editor refused it.
bool isRefused(const QWidget& field) {
  if (field.property("refused").toBool()) return true;
  for (const QWidget* each = field.parentWidget(); each && !qobject_cast<const QDockWidget*>(each);
       each = each->parentWidget()) {
    const auto* refusal = each->findChild<QLabel*>("refusal", Qt::FindDirectChildrenOnly);
    if (refusal) return refusal->isVisible();
  }
  return false;
}

/// True if the user needs the keys there: unfinished input, or chosen text to copy.
bool keepsKeys(const QWidget& widget) {
  const auto* label = qobject_cast<const QLabel*>(&widget);
  return hasUnfinishedInput(widget) || (label && label->hasSelectedText());
}

}  // namespace

KeyboardFocus::KeyboardFocus(QMainWindow& window, QWidget& view) : window_(window), view_(view) {
  qApp->installEventFilter(this);
  connect(qApp, &QApplication::focusChanged, this, &KeyboardFocus::followFocus);
  // Panels behind another tab keep the focus, as Qt does not hide them.
  for (QDockWidget* panel : window.findChildren<QDockWidget*>())
    connect(panel, &QDockWidget::visibilityChanged, this, [this, panel](bool isVisible) {
      const QWidget* focus = QApplication::focusWidget();
      if (!isVisible && focus && panel->isAncestorOf(focus)) view_.setFocus();
    });
  view.setFocus();
}

bool KeyboardFocus::isInPanel(const QWidget& widget) const {
  for (const QWidget* each = &widget; each; each = each->parentWidget()) {
    if (each->parentWidget() == &window_)
      return qobject_cast<const QDockWidget*>(each) || qobject_cast<const QToolBar*>(each) ||
             qobject_cast<const QStatusBar*>(each);
  }
  return false;
}

bool KeyboardFocus::eventFilter(QObject* watched, QEvent* event) {
  const bool isOfView = watched == &view_ &&
                        (event->type() == QEvent::Enter || event->type() == QEvent::WindowActivate);
  if (isOfView && (event->type() == QEvent::Enter || view_.underMouse())) followPointer();
  if (event->type() != QEvent::KeyPress || !watched->isWidgetType()) return false;
  auto& widget = *static_cast<QWidget*>(watched);
  const auto& key = static_cast<const QKeyEvent&>(*event);
  const bool isEnter = key.key() == Qt::Key_Return || key.key() == Qt::Key_Enter;
  if (!isPlainKey(key) || (key.key() != Qt::Key_Escape && !isEnter) || !isInPanel(widget) ||
      isInList(widget) || QApplication::activePopupWidget())
    return false;
  if (isEnter) return isField(widget) && enter(widget, *event);
  return escape(widget);
}

bool KeyboardFocus::escape(QWidget& widget) {
  const bool wasField = isField(widget);
  if (wasField) dropInput(widget, former_);
  view_.setFocus();
  if (wasField) return true;
  QKeyEvent press(QEvent::KeyPress, Qt::Key_Escape, Qt::NoModifier);
  QApplication::sendEvent(&view_, &press);
  return true;
}

bool KeyboardFocus::enter(QWidget& field, QEvent& event) {
  const QPointer<QWidget> guard(&field);
  static_cast<QObject&>(field).event(&event);
  event.accept();
  if (guard && guard->hasFocus() && !isRefused(*guard)) view_.setFocus();
  return true;
}

void KeyboardFocus::followPointer() {
  if (QApplication::activePopupWidget() || QApplication::activeModalWidget() ||
      QApplication::mouseButtons() != Qt::NoButton)
    return;
  QWidget* focus = QApplication::focusWidget();
  if (!focus) {
    if (window_.isActiveWindow()) view_.setFocus();
    return;
  }
  if (!isInPanel(*focus) || keepsKeys(*focus)) return;
  if (focus->window() != &window_) window_.activateWindow();  // a panel that was torn off
  view_.setFocus();
}

void KeyboardFocus::followFocus(QWidget* old, QWidget* now) {
  if (field_) field_->disconnect(this);
  field_ = nullptr;
  if (!now) {
    // Nothing would receive the keys, or with Tab the first field.
    if (window_.isVisible() && window_.isActiveWindow() && !window_.focusWidget()) view_.setFocus();
    return;
  }
  if (!isInPanel(*now)) return;
  // Qt passes the focus of a hidden or disabled widget to the next field.
  if (old && old->window() == now->window() && !now->isAncestorOf(old) &&
      (!old->isVisible() || !old->isEnabled())) {
    view_.setFocus();
    return;
  }
  if (qobject_cast<QAbstractSpinBox*>(now)) {
    // Enter leaves the text of a number box marked as edited.
    now->findChild<QLineEdit*>()->setModified(false);
  } else if (auto* edit = qobject_cast<QLineEdit*>(now)) {
    field_ = edit;
    former_ = edit->text();
    connect(edit, &QLineEdit::textChanged, this, [this, edit] {
      if (!edit->isModified()) former_ = edit->text();
    });
  }
}

}  // namespace palpa::gui
