#include "app/gui/tools/select_tool.h"

#include <QCoreApplication>

namespace palpa::gui {
namespace {

constexpr double kDragThreshold = 3;  // pixels before a press becomes a drag

Eigen::Vector3d directionOf(view::GizmoAxis axis) {
  switch (axis) {
    case view::GizmoAxis::kX:
      return Eigen::Vector3d::UnitX();
    case view::GizmoAxis::kY:
      return Eigen::Vector3d::UnitY();
    default:
      return Eigen::Vector3d::UnitZ();
  }
}

}  // namespace

SelectTool::SelectTool(Editor& editor, SceneController& scene, ViewportWidget& widget)
    : editor_(editor), scene_(scene), widget_(widget) {}

bool SelectTool::press(const PointerEvent& event) {
  if (event.button != Qt::LeftButton || !editor_.solid()) return false;
  pressed_ = event.pixel;
  moved_.setZero();
  hasMoved_ = false;
  axis_ = widget_.viewport().gizmoAt(event.pixel);
  // A control point under the middle of the gizmo moves as freely, and can be taken out with Shift.
  if (axis_ == view::GizmoAxis::kAll && widget_.viewport().controlPointAt(event.pixel))
    axis_ = view::GizmoAxis::kNone;
  if (axis_ != view::GizmoAxis::kNone) {
    start_ = *scene_.selectionCentre();
    mode_ = Mode::kDrag;
  } else if (const auto point = widget_.viewport().controlPointAt(event.pixel)) {
    std::set<int> selection = editor_.selection().points;
    if ((event.modifiers & Qt::ShiftModifier) != 0) {
      if (!selection.erase(*point)) selection.insert(*point);
    } else if (!selection.contains(*point)) {
      selection = {*point};
    }
    const bool isSelected = selection.contains(*point);
    editor_.select(Selection::ofPoints(std::move(selection)));
    start_ = editor_.solid()->controlPoints()[*point];
    mode_ = isSelected ? Mode::kDrag : Mode::kNone;
  } else {
    mode_ = Mode::kBox;
  }
  if (mode_ == Mode::kDrag) grip_ = dragTarget(event.pixel).value_or(start_);
  return true;
}

std::optional<Eigen::Vector3d> SelectTool::dragTarget(const Eigen::Vector2d& pixel) const {
  const bool isFree = axis_ == view::GizmoAxis::kNone || axis_ == view::GizmoAxis::kAll;
  if (isFree) return widget_.viewport().inViewPlane(pixel, start_);
  return widget_.viewport().onLine(pixel, start_, directionOf(axis_));
}

void SelectTool::drag(const Eigen::Vector2d& pixel) {
  const auto target = dragTarget(pixel);
  if (!target || !target->allFinite()) return;
  // The first motion begins a step of undo; the others are united with it.
  const Eigen::Vector3d by = *target - grip_ - moved_;
  const modeling::MovePoints command{
      modeling::PointSelection::of(
          {editor_.selection().points.begin(), editor_.selection().points.end()}),
      modeling::MoveBy{by},
      {}};
  if (editor_.perform(command, hasMoved_ ? modeling::Merge::withLast : modeling::Merge::no)) {
    moved_ += by;
    hasMoved_ = true;
  }
}

bool SelectTool::move(const PointerEvent& event) {
  if (mode_ == Mode::kNone) {
    if ((event.buttons & Qt::LeftButton) == 0) {
      const view::GizmoAxis axis = widget_.viewport().gizmoAt(event.pixel);
      scene_.setGizmoAxis(axis);
      scene_.setHovered(axis == view::GizmoAxis::kNone
                            ? widget_.viewport().controlPointAt(event.pixel)
                            : std::nullopt);
    }
    return false;
  }
  if (!hasMoved_ && (event.pixel - pressed_).norm() < kDragThreshold) return true;
  if (mode_ == Mode::kDrag) {
    drag(event.pixel);
  } else {
    widget_.viewport().setRubberBand(std::array{pressed_, event.pixel});
    widget_.update();
  }
  return true;
}

bool SelectTool::release(const PointerEvent& event) {
  if (mode_ == Mode::kBox) {
    widget_.viewport().setRubberBand(std::nullopt);
    const bool add = (event.modifiers & Qt::ShiftModifier) != 0;
    std::set<int> selection = add ? editor_.selection().points : std::set<int>();
    if ((event.pixel - pressed_).norm() >= kDragThreshold)
      for (int point : widget_.viewport().controlPointsIn(pressed_, event.pixel))
        selection.insert(point);
    editor_.select(Selection::ofPoints(std::move(selection)));
    widget_.update();
  }
  mode_ = Mode::kNone;
  return true;
}

bool SelectTool::cancel() {
  if (mode_ == Mode::kNone) {
    if (editor_.selection().empty()) return false;
    editor_.select({});
    return true;
  }
  if (mode_ == Mode::kBox) widget_.viewport().setRubberBand(std::nullopt);
  if (mode_ == Mode::kDrag && hasMoved_) editor_.undo();
  mode_ = Mode::kNone;
  widget_.update();
  return true;
}

QCursor SelectTool::cursor() const {
  return mode_ == Mode::kDrag ? Qt::ClosedHandCursor : Qt::ArrowCursor;
}

QString SelectTool::hint() const {
  return QCoreApplication::translate(
      "SelectTool",
      "Click or box-select control points, Shift adds; drag to move them, by the "
      "arrows along an axis; Escape cancels");
}

}  // namespace palpa::gui
