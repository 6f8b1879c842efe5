#include <QKeyEvent>

#include "app/gui/dialogs/profile_canvas.h"

// Keys of ProfileCanvas.

namespace palpa::gui {

using Eigen::Vector2d;
using modeling::ProfileSketch;

bool ProfileCanvas::event(QEvent* event) {
  // Keys of the canvas that are also shortcuts of the window or the dialog.
  if (event->type() == QEvent::ShortcutOverride) {
    const auto* key = static_cast<QKeyEvent*>(event);
    const bool isBusy =
        drag_ != Drag::kNone || mode_ == Mode::kDraw || !editor_.selection().empty();
    if (key->key() == Qt::Key_Escape && isBusy) {
      event->accept();
      return true;
    }
  }
  return QWidget::event(event);
}

void ProfileCanvas::moveByKeys(QKeyEvent* event) {
  if (editor_.selection().empty()) return;
  double step = gridStep();
  if ((event->modifiers() & Qt::ShiftModifier) != 0) step *= 10.0;
  if ((event->modifiers() & Qt::ControlModifier) != 0) step *= 0.1;
  Vector2d by = Vector2d::Zero();
  if (event->key() == Qt::Key_Left) by.x() = -step;
  if (event->key() == Qt::Key_Right) by.x() = step;
  if (event->key() == Qt::Key_Up) by.y() = step;
  if (event->key() == Qt::Key_Down) by.y() = -step;
  editor_.edit(
      tr("Move points"), [&](ProfileSketch& edited) { edited.move(editor_.selection(), by); },
      event->isAutoRepeat());
}

void ProfileCanvas::keyPressEvent(QKeyEvent* event) {
  const bool isDrawing = mode_ == Mode::kDraw;
  switch (event->key()) {
    case Qt::Key_Escape:
      if (drag_ != Drag::kNone) {
        cancelDrag();
      } else if (isDrawing) {
        setMode(Mode::kSelect);
      } else if (!editor_.selection().empty()) {
        editor_.select({});
      } else {
        event->ignore();
      }
      return;
    case Qt::Key_Return:
    case Qt::Key_Enter:
      if (isDrawing && event->modifiers() == Qt::NoModifier)
        setMode(Mode::kSelect);
      else
        event->ignore();
      return;
    case Qt::Key_Left:
    case Qt::Key_Right:
    case Qt::Key_Up:
    case Qt::Key_Down:
      moveByKeys(event);
      return;
    case Qt::Key_PageDown:
      editor_.step(1);
      return;
    case Qt::Key_PageUp:
      editor_.step(-1);
      return;
    case Qt::Key_Plus:
    case Qt::Key_Equal:
      zoom(1.25, QPointF(0.5 * width(), 0.5 * height()));
      return;
    case Qt::Key_Minus:
      zoom(0.8, QPointF(0.5 * width(), 0.5 * height()));
      return;
    case Qt::Key_Backspace:
      if (isDrawing && !editor_.sketch().isClosed() && editor_.sketch().pointCount() > 0)
        editor_.edit(tr("Delete points"),
                     [](ProfileSketch& edited) { edited.remove({edited.pointCount() - 1}); });
      else
        editor_.removeSelected();
      return;
    case Qt::Key_Delete:
      editor_.removeSelected();
      return;
    default:
      QWidget::keyPressEvent(event);
  }
}

}  // namespace palpa::gui
