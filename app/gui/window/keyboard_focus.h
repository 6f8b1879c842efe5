#pragma once

#include <QMainWindow>
#include <QPointer>

namespace palpa::gui {

/// Decides which widget of the window receives the keys:
/// - the view, from the moment the pointer enters it, unless a field has unfinished input;
/// - a field of a panel, from a click or Tab to Enter (which applies the input) or Escape (which
///   drops it); then the view again;
/// - the view instead of the next field in the order of Tab, if the widget with the focus is
/// hidden,
///   disabled or removed.
/// Escape in other widgets of panels acts as in the view.
class KeyboardFocus : public QObject {
  Q_OBJECT

 public:
  /// The window must have all its panels.
  KeyboardFocus(QMainWindow& window, QWidget& view);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  bool isInPanel(const QWidget& widget) const;
  void followPointer();
  void followFocus(QWidget* old, QWidget* now);
  bool escape(QWidget& widget);
  bool enter(QWidget& field, QEvent& event);

  QMainWindow& window_;
  QWidget& view_;
  QPointer<QWidget> field_;  // with the focus
  QString former_;           // text of the field without unfinished input
};

}  // namespace palpa::gui
