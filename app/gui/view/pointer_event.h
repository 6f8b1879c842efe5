#pragma once

#include <Eigen/Core>
#include <QEvent>

namespace palpa::gui {

/// A press becomes a drag after a path of this many pixels.
inline constexpr double kDragThreshold = 3;

/// A mouse event in the view, in device pixels from its top left corner.
struct PointerEvent {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Qt::MouseButton button = Qt::NoButton;
  Qt::MouseButtons buttons = Qt::NoButton;
  Qt::KeyboardModifiers modifiers = Qt::NoModifier;
};

}  // namespace palpa::gui
