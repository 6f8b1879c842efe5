#include "app/gui/tools/point_tool.h"

#include <Eigen/Geometry>

#include "app/gui/document/point_groups.h"
#include "app/gui/document/touch_gradient.h"
#include "app/gui/tools/motion_geometry.h"

namespace palpa::gui {
namespace {

using Eigen::Vector3d;
using view::GizmoAxis;

constexpr double kWheelFactor = 1.15;  // of the falloff, per notch

}  // namespace

PointTool::PointTool(const Workspace& workspace, PointOptions& options)
    : workspace_(workspace),
      options_(options),
      picker_(workspace.editor, workspace.scene, workspace.view, options) {
  // A change of project or selection by others ends the motion.
  const auto outside = [this] {
    if (!isActive_ || isApplying_) return;
    abandon();
    refresh();
  };
  connect(&workspace.editor, &Editor::projectReplaced, this, outside);
  connect(&workspace.editor, &Editor::projectChanged, this, outside);
  connect(&workspace.editor, &Editor::selectionChanged, this, outside);
  // A rebuild confirms or corrects the predicted stiffness.
  connect(&workspace.editor.gradient(), &TouchGradient::changed, this, [this] {
    if (isActive_ && motion_ && !isApplying_) draw();
  });
  connect(&options, &PointOptions::changed, this, [this] {
    if (!isActive_ || isApplying_) return;
    if (motion_) {
      motion_->reach = options_.reach(*workspace_.editor.solid());
      apply(motion_->amount, true);
    } else {
      picker_.unhover();
    }
    refresh();
  });
}

void PointTool::activate() {
  isActive_ = true;
  workspace_.scene.setGizmoKind(kind());
  refresh();
}

void PointTool::deactivate() {
  if (motion_ || picker_.isInBox()) cancel();
  pressed_.reset();
  isActive_ = false;
  picker_.unhover();
  workspace_.scene.setGizmoKind(std::nullopt);
  workspace_.scene.setFollowing({});
  workspace_.view.viewport().setToolDrawing({});
}

std::set<int> PointTool::movedPoints() const {
  const modeling::Solid* solid = workspace_.editor.solid();
  return solid ? pointsOf(workspace_.editor.selection(), *solid) : std::set<int>();
}

bool PointTool::press(const PointerEvent& event) {
  pointer_ = event.pixel;
  if (event.button == Qt::RightButton) return motion_ && cancel();
  if (event.button != Qt::LeftButton) return false;
  if (motion_) {
    finish();
    return true;
  }
  pressed_.reset();
  pressedPoint_.reset();
  pressedAxis_ = workspace_.view.viewport().gizmoAt(event.pixel);
  // A control point under the centre of the gizmo also moves freely, and Shift can deselect it.
  if (pressedAxis_ == GizmoAxis::kAll && picker_.pointPlaceAt(event.pixel))
    pressedAxis_ = GizmoAxis::kNone;
  if (pressedAxis_ != GizmoAxis::kNone) {
    pressed_ = event.pixel;
    return true;
  }
  // The number of a dimension lies over everything.
  if (workspace_.scene.dimensions().selectAt(event.pixel)) return true;
  const bool toggle = (event.modifiers & (Qt::ShiftModifier | Qt::ControlModifier)) != 0;
  pressedPoint_ = picker_.pointPlaceAt(event.pixel);
  if (!toggle && picker_.isSelectedAt(event.pixel)) {
    pressed_ = event.pixel;
  } else if (pressedPoint_) {
    workspace_.editor.select(*picker_.clicked(event.pixel, toggle));
    if (picker_.isSelectedAt(event.pixel) && !toggle) pressed_ = event.pixel;
  } else {
    picker_.beginBox(event.pixel);
  }
  return true;
}

bool PointTool::move(const PointerEvent& event) {
  pointer_ = event.pixel;
  if (pressed_ && (event.pixel - *pressed_).norm() >= kDragThreshold) {
    const GizmoAxis axis = pressedAxis_ == GizmoAxis::kNone ? GizmoAxis::kAll : pressedAxis_;
    const Eigen::Vector2d from = *pressed_;
    pressed_.reset();
    begin(axis, from, false);
  }
  if (motion_) {
    setSnapping((event.modifiers & Qt::ControlModifier) != 0);
    follow();
    return true;
  }
  if (picker_.isInBox()) {
    picker_.stretchBox(event.pixel);
    return true;
  }
  if (!pressed_ && (event.buttons & Qt::LeftButton) == 0) {
    const GizmoAxis axis = workspace_.view.viewport().gizmoAt(event.pixel);
    workspace_.scene.setGizmoAxis(axis);
    const auto edge = picker_.hoveredEdge();
    if (axis == GizmoAxis::kNone)
      picker_.hover(event.pixel);
    else
      picker_.unhover();
    if (edge != picker_.hoveredEdge()) draw();
  }
  return false;
}

bool PointTool::release(const PointerEvent& event) {
  if (event.button != Qt::LeftButton) return false;
  if (motion_ && !motion_->isByKeys) {
    finish();
  } else if (picker_.isInBox()) {
    picker_.endBox(event);
  } else if (pressed_ && pressedAxis_ == GizmoAxis::kNone) {
    // A click without a drag on one of several selected items selects only this item.
    if (const auto selection = picker_.clicked(*pressed_, false))
      workspace_.editor.select(*selection);
  }
  pressed_.reset();
  return true;
}

bool PointTool::doubleClick(const PointerEvent& event) {
  if (event.button != Qt::LeftButton || motion_ || picker_.pointPlaceAt(event.pixel) ||
      workspace_.view.viewport().gizmoAt(event.pixel) != GizmoAxis::kNone)
    return press(event);
  return picker_.selectPointsOfPatchAt(event.pixel, (event.modifiers & Qt::ShiftModifier) != 0);
}

bool PointTool::wheel(const PointerEvent&, double notches) {
  if (!motion_ || !options_.hasFalloff()) return false;
  options_.setFalloff(options_.falloff() * std::pow(kWheelFactor, notches));
  return true;
}

void PointTool::leave() {
  if (motion_) return;
  picker_.unhover();
  workspace_.scene.setGizmoAxis(GizmoAxis::kNone);
  draw();
}

void PointTool::begin(GizmoAxis axis, const Eigen::Vector2d& pixel, bool isByKeys) {
  const std::set<int> points = movedPoints();
  if (points.empty()) return;
  const modeling::Solid& solid = *workspace_.editor.solid();
  Motion motion;
  motion.centre = meanOf(points, solid);
  motion.place =
      pressedPoint_ && axis == GizmoAxis::kAll && !isByKeys ? *pressedPoint_ : motion.centre;
  motion.normal = meanNormal(points, solid);
  const TouchGradient& gradient = workspace_.editor.gradient();
  motion.gradient = gradient.directionOf(points).value_or(Vector3d(Vector3d::Zero()));
  if (const auto stiffness = gradient.stiffness(); stiffness && gradient.areArrowsShown())
    motion.stiffness = stiffness->value;
  motion.from = motion.pixel = pixel;
  motion.points = modeling::PointSelection::of({points.begin(), points.end()});
  motion.reach = options_.reach(solid);
  motion.before = solid.controlPoints();
  motion.amount = neutral();
  motion.isByKeys = isByKeys;
  motion.snaps = options_.snaps();
  std::set<int> following = followersOf(points, motion.reach, solid);
  following.insert(points.begin(), points.end());
  motion.snapPlaces = SnapPlaces(solid, following, workspace_.scene);
  motion_ = std::move(motion);
  picker_.unhover();
  // The arrows would cover the typed number; a line shows the axis instead.
  workspace_.scene.setGizmoKind(std::nullopt);
  if (axis != GizmoAxis::kAll) constrain(axis);
  draw();
  Q_EMIT changed();
}

void PointTool::constrain(GizmoAxis axis) {
  if (!allows(axis)) return;
  if (axis == GizmoAxis::kNormal && motion_->normal.isZero()) {
    Q_EMIT workspace_.editor.said(tr("The normals of the selected points cancel each other"));
    return;
  }
  if (axis == GizmoAxis::kGradient && motion_->gradient.isZero()) {
    Q_EMIT workspace_.editor.said(
        tr("One point with an arrow moves along it: show the arrows with View > Gradient arrows"));
    return;
  }
  motion_->axis = motion_->axis == axis ? GizmoAxis::kAll : axis;
  workspace_.scene.setGizmoAxis(motion_->axis);
  const auto amount = motion_->typed.isEmpty() ? pointed(*motion_, motion_->snaps)
                                               : entered(*motion_, motion_->typed);
  apply(amount.value_or(neutral()), true);
}

void PointTool::setSnapping(bool isReversed) {
  motion_->snaps = options_.snaps() != isReversed;
}

void PointTool::follow() {
  const Eigen::Vector2d centre = workspace_.view.viewport().toPixel(motion_->centre);
  if (centre.allFinite()) motion_->turned += degreesAround(centre, motion_->pixel, pointer_);
  motion_->pixel = pointer_;
  if (!motion_->typed.isEmpty()) return;
  motion_->target =
      motion_->snaps ? motion_->snapPlaces.near(motion_->pixel, workspace_.view) : std::nullopt;
  const auto amount = pointed(*motion_, motion_->snaps);
  if (amount && amount->allFinite()) apply(*amount, false);
}

void PointTool::type(const QString& text) {
  motion_->typed = text;
  const auto amount = text.isEmpty() ? pointed(*motion_, motion_->snaps) : entered(*motion_, text);
  if (amount)
    apply(*amount, true);
  else
    draw();
}

void PointTool::apply(const Amount& amount, bool fromStart) {
  Editor& editor = workspace_.editor;
  isApplying_ = true;
  // A motion back to its start has no undo step; compare the points to find out.
  const bool isStep = editor.solid()->controlPoints() != motion_->before;
  const auto step = between(motion_->amount, amount);
  if (isStep && !fromStart && step) {
    if (editor.perform(command(*motion_, *step), modeling::Merge::kWithLast))
      motion_->amount = amount;
  } else {
    if (isStep) editor.undo();
    const bool isDone =
        amount == neutral() || editor.perform(command(*motion_, amount), modeling::Merge::kNo);
    motion_->amount = isDone ? amount : neutral();
  }
  isApplying_ = false;
  draw();
}

void PointTool::finish() {
  motion_.reset();
  workspace_.scene.setGizmoKind(kind());
  workspace_.editor.endMotion();
  workspace_.scene.setGizmoAxis(GizmoAxis::kNone);
  workspace_.view.setCursor(cursor());
  refresh();
  Q_EMIT changed();
}

void PointTool::abandon() {
  pressed_.reset();
  if (!motion_) return;
  motion_.reset();
  workspace_.scene.setGizmoKind(kind());
  workspace_.scene.setGizmoAxis(GizmoAxis::kNone);
  Q_EMIT changed();
}

bool PointTool::cancel() {
  pressed_.reset();
  if (motion_) {
    isApplying_ = true;
    if (workspace_.editor.solid()->controlPoints() != motion_->before) workspace_.editor.undo();
    isApplying_ = false;
    finish();
    return true;
  }
  if (picker_.isInBox()) {
    picker_.cancelBox();
    return true;
  }
  return false;
}

QCursor PointTool::cursor() const {
  return motion_ ? Qt::ClosedHandCursor : Qt::ArrowCursor;
}

QWidget* PointTool::makeOptions(QWidget* parent) {
  return options_.makeWidget(workspace_.settings, parent);
}

}  // namespace palpa::gui
