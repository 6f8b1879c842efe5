#include <Eigen/Geometry>

#include "app/gui/tools/motion_geometry.h"
#include "app/gui/tools/point_tool.h"

// Keys of PointTool.

namespace palpa::gui {
namespace {

using view::GizmoAxis;

std::optional<GizmoAxis> axisOfKey(int key) {
  switch (key) {
    case Qt::Key_X:
      return GizmoAxis::kX;
    case Qt::Key_Y:
      return GizmoAxis::kY;
    case Qt::Key_Z:
      return GizmoAxis::kZ;
    case Qt::Key_N:
      return GizmoAxis::kNormal;
    case Qt::Key_K:
      return GizmoAxis::kGradient;
    default:
      return std::nullopt;
  }
}

/// True without Ctrl, Alt and Meta; Shift and the key pad do not matter.
bool isPlain(const QKeyEvent& event) {
  return (event.modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier)) == 0;
}

bool isArrow(int key) {
  return key == Qt::Key_Left || key == Qt::Key_Right || key == Qt::Key_Up || key == Qt::Key_Down;
}

}  // namespace

bool PointTool::wantsKey(const QKeyEvent& event) const {
  if (motion_) return true;  // shortcuts must not change the project during a motion
  if (!isPlain(event) || workspace_.editor.selection().named) return false;
  const int key = event.key();
  const bool begins = key == Qt::Key_G || key == Qt::Key_X || key == Qt::Key_Y || key == Qt::Key_Z;
  return (isArrow(key) || (begins && (event.modifiers() & Qt::ShiftModifier) == 0)) &&
         !movedPoints().empty();
}

bool PointTool::key(QKeyEvent* event) {
  if (motion_) return motionKey(*event);
  if (!wantsKey(*event)) return false;
  if (isArrow(event->key())) return nudge(*event);
  if (event->isAutoRepeat()) return true;
  begin(axisOfKey(event->key()).value_or(GizmoAxis::kAll), pointer_, true);
  workspace_.view.setCursor(cursor());
  return true;
}

bool PointTool::motionKey(const QKeyEvent& event) {
  const int key = event.key();
  QString typed = motion_->typed;
  if (key == Qt::Key_Return || key == Qt::Key_Enter) {
    finish();
  } else if (const auto axis = axisOfKey(key); axis && isPlain(event)) {
    if (!event.isAutoRepeat()) constrain(*axis);
  } else if (key == Qt::Key_Backspace) {
    typed.chop(1);
    type(typed);
  } else if (key == Qt::Key_Minus) {
    type(typed.startsWith('-') ? typed.mid(1) : "-" + typed);
  } else if (const QString text = event.text();
             text.size() == 1 && (text[0].isDigit() || text == "." || text == ",")) {
    type(typed + text);
  }
  return true;
}

bool PointTool::nudge(const QKeyEvent& event) {
  const auto [right, up] = screenAxes();
  const Eigen::Vector3d x = nearestAxis(right);
  Eigen::Index taken = 0;
  x.cwiseAbs().maxCoeff(&taken);
  const Eigen::Vector3d y = nearestAxis(up, static_cast<int>(taken));
  Eigen::Vector3d by = event.key() == Qt::Key_Left || event.key() == Qt::Key_Right ? x : y;
  if (event.key() == Qt::Key_Left || event.key() == Qt::Key_Down) by = -by;
  by *= lengthStep() * ((event.modifiers() & Qt::ShiftModifier) != 0 ? 10 : 1);
  const std::set<int> points = movedPoints();
  // Repeats of a pressed key are one undo step.
  workspace_.editor.perform(
      modeling::MovePoints{modeling::PointSelection::of({points.begin(), points.end()}),
                           modeling::MoveBy{by}, options_.reach(*workspace_.editor.solid())},
      event.isAutoRepeat() ? modeling::Merge::kWithLast : modeling::Merge::kNo);
  return true;
}

KeyHelp PointTool::keyHelp() const {
  return {tr("Moving, rotating and scaling points"),
          {{tr("Begin without a drag"), tr("G, or X, Y, Z")},
           {tr("Restrict to an axis or the normal; again: free"), tr("X, Y, Z, N")},
           {tr("Restrict to the arrow of the stiffness gradient; again: free"), tr("K")},
           {tr("Exact length, angle or factor"), tr("Digits, Backspace")},
           {tr("Snap to points, edges and the grid; round angles and factors"), tr("Ctrl")},
           {tr("Radius of the falloff"), tr("Wheel")},
           {tr("Nudge; ten times as far"), tr("Arrow keys; with Shift")},
           {tr("Confirm; undo"), tr("Enter or click; Escape or right button")}}};
}

}  // namespace palpa::gui
