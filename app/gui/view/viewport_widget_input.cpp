#include <QKeyEvent>
#include <QMouseEvent>
#include <cmath>
#include <utility>

#include "app/gui/view/viewport_widget.h"

// Pointer and keys of ViewportWidget: navigation, the view cube, and events for the tool.

namespace palpa::gui {

Eigen::Vector2d ViewportWidget::toDevice(const QPointF& point) const {
  return Eigen::Vector2d(point.x(), point.y()) * devicePixelRatioF();
}

PointerEvent ViewportWidget::pointerEvent(const QMouseEvent& event) const {
  return {toDevice(event.position()), event.button(), event.buttons(), event.modifiers()};
}

void ViewportWidget::mousePressEvent(QMouseEvent* event) {
  setFocus(Qt::MouseFocusReason);
  noticeReleases(*event);
  last_ = toDevice(event->position());
  if (event->button() == Qt::RightButton && tool_ && tool_->press(pointerEvent(*event))) {
    pressed_ = Qt::RightButton;
    return;
  }
  const bool middle = event->button() == Qt::MiddleButton;
  const bool altLeft =
      event->button() == Qt::LeftButton && (event->modifiers() & Qt::AltModifier) != 0;
  if (middle || altLeft || event->button() == Qt::RightButton) {
    const bool pan =
        (event->modifiers() & Qt::ShiftModifier) != 0 || event->button() == Qt::RightButton;
    navigation_ = pan ? Navigation::kPan : Navigation::kOrbit;
    navigating_ = event->button();
    return;
  }
  if (pressCube(*event)) return;
  pressed_ = event->button();
  if (tool_) tool_->press(pointerEvent(*event));
}

std::optional<view::ViewCubePart> ViewportWidget::cubePartAt(const QMouseEvent& event) const {
  if (tool_ && tool_->followsPointer()) return std::nullopt;
  return viewport_->cubePartAt(toDevice(event.position()));
}

bool ViewportWidget::pressCube(const QMouseEvent& event) {
  if (event.button() != Qt::LeftButton) return false;
  pressedCube_ = cubePartAt(event);
  return pressedCube_.has_value();
}

bool ViewportWidget::moveOverCube(const QMouseEvent& event) {
  if ((event.buttons() & Qt::LeftButton) == 0) pressedCube_.reset();
  if (pressedCube_) {
    // A drag of the cube orbits.
    if ((toDevice(event.position()) - last_).norm() < kDragThreshold * devicePixelRatioF())
      return true;
    pressedCube_.reset();
    hoverCube(std::nullopt);
    navigation_ = Navigation::kOrbit;
    navigating_ = Qt::LeftButton;
    navigate(toDevice(event.position()));
    return true;
  }
  hoverCube(event.buttons() == Qt::NoButton ? cubePartAt(event) : std::nullopt);
  return hoveredCube_.has_value();
}

void ViewportWidget::hoverCube(const std::optional<view::ViewCubePart>& part) {
  if (part == hoveredCube_) return;
  if (part && !hoveredCube_ && tool_) tool_->leave();
  hoveredCube_ = part;
  viewport_->setHoveredCubePart(part);
  if (part) setCursor(Qt::PointingHandCursor);
  update();
}

void ViewportWidget::releaseCube(const QMouseEvent& event) {
  const auto part = std::exchange(pressedCube_, std::nullopt);
  if (!part || cubePartAt(event) != part) return;
  viewport_->lookAtCubePart(*part);
  // Another part may lie under the pointer now.
  hoverCube(cubePartAt(event));
  update();
}

void ViewportWidget::noticeReleases(const QMouseEvent& event) {
  Qt::MouseButtons stillPressed = event.buttons();
  if (event.type() == QEvent::MouseButtonPress) stillPressed.setFlag(event.button(), false);
  if ((stillPressed & navigating_) == 0) {
    navigation_ = Navigation::kNone;
    navigating_ = Qt::NoButton;
  }
  if (pressed_ == Qt::NoButton || (stillPressed & pressed_) != 0) return;
  const Qt::MouseButton released = std::exchange(pressed_, Qt::NoButton);
  if (tool_) tool_->release({last_, released, event.buttons(), event.modifiers()});
}

void ViewportWidget::mouseMoveEvent(QMouseEvent* event) {
  noticeReleases(*event);
  if (navigation_ != Navigation::kNone) {
    navigate(toDevice(event->position()));
    return;
  }
  if (moveOverCube(*event)) return;
  last_ = toDevice(event->position());
  if (tool_) {
    tool_->move(pointerEvent(*event));
    setCursor(tool_->cursor());
  }
}

void ViewportWidget::navigate(const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d step = pixel - last_;
  if (navigation_ == Navigation::kOrbit)
    viewport_->orbit(step);
  else
    viewport_->pan(step, last_);
  last_ = pixel;
  updateQuickly();
}

void ViewportWidget::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() == navigating_) {
    navigation_ = Navigation::kNone;
    navigating_ = Qt::NoButton;
    return;
  }
  if (event->button() == Qt::LeftButton && pressedCube_) {
    releaseCube(*event);
    return;
  }
  if (event->button() == pressed_) pressed_ = Qt::NoButton;
  if (tool_) tool_->release(pointerEvent(*event));
}

void ViewportWidget::mouseDoubleClickEvent(QMouseEvent* event) {
  noticeReleases(*event);
  last_ = toDevice(event->position());
  if (pressCube(*event)) return;
  pressed_ = event->button();
  if (tool_) tool_->doubleClick(pointerEvent(*event));
}

void ViewportWidget::wheelEvent(QWheelEvent* event) {
  // Touchpads send fractions of a notch.
  const double notches = event->angleDelta().y() / 120.0;
  if (notches == 0.0) return;
  const PointerEvent at{toDevice(event->position()), Qt::NoButton, event->buttons(),
                        event->modifiers()};
  if (tool_ && tool_->wheel(at, notches)) return;
  viewport_->zoom(std::pow(1.15, notches), toDevice(event->position()));
  updateQuickly();
  event->accept();
}

void ViewportWidget::leaveEvent(QEvent*) {
  hoverCube(std::nullopt);
  if (tool_) tool_->leave();
}

void ViewportWidget::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) {
    if (!tool_ || !tool_->cancel()) Q_EMIT escaped();
    return;
  }
  if (tool_ && tool_->key(event)) return;
  if (event->modifiers() == Qt::NoModifier) Q_EMIT keyUnused(event->key());
  QWidget::keyPressEvent(event);
}

bool ViewportWidget::event(QEvent* event) {
  // Keys of the tool must not trigger shortcuts of the menus (x, y, z, digits during a motion).
  if (event->type() == QEvent::ShortcutOverride && tool_) {
    auto* key = static_cast<QKeyEvent*>(event);
    if (key->key() == Qt::Key_Escape || tool_->wantsKey(*key)) {
      event->accept();
      return true;
    }
  }
  // Otherwise Tab would move the focus before the tool receives it.
  if (event->type() == QEvent::KeyPress && tool_) {
    auto* key = static_cast<QKeyEvent*>(event);
    if (key->key() == Qt::Key_Tab && tool_->wantsKey(*key)) {
      keyPressEvent(key);
      return true;
    }
  }
  return QWidget::event(event);
}

}  // namespace palpa::gui
