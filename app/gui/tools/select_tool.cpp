#include "app/gui/tools/select_tool.h"

#include "app/gui/tools/motion_geometry.h"

namespace palpa::gui {

using view::GizmoAxis;

// Along normals the amount is the distance, in x: each point has another direction.
SelectTool::Amount SelectTool::along(const Motion& motion, const Eigen::Vector3d& direction,
                                     double distance) {
  return motion.axis == GizmoAxis::kNormal ? Amount(distance, 0, 0) : Amount(distance * direction);
}

std::optional<SelectTool::Amount> SelectTool::pointed(const Motion& motion, bool snap) const {
  const view::Viewport& viewport = workspace_.view.viewport();
  const double step = lengthStep();
  if (motion.axis == GizmoAxis::kAll) {
    Amount by = viewport.inViewPlane(motion.pixel, motion.place) -
                viewport.inViewPlane(motion.from, motion.place);
    if (snap)
      for (double& component : by) component = snapped(component, step);
    return by;
  }
  const Eigen::Vector3d direction = directionOf(motion);
  const auto from = viewport.onLine(motion.from, motion.place, direction);
  const auto to = viewport.onLine(motion.pixel, motion.place, direction);
  if (!from || !to) return std::nullopt;
  const double distance = direction.dot(*to - *from);
  return along(motion, direction, snap ? snapped(distance, step) : distance);
}

std::optional<SelectTool::Amount> SelectTool::entered(const Motion& motion,
                                                      const QString& text) const {
  const auto distance = parsed(text, Quantity::kLength, units());
  if (!distance) return std::nullopt;
  if (motion.axis != GizmoAxis::kAll) return along(motion, directionOf(motion), *distance);
  // Without an axis: the direction of the pointer's path, or x without a path.
  const Amount path = pointed(motion, false).value_or(Amount(Amount::Zero()));
  return Amount(*distance * (path.isZero() ? Amount(Amount::UnitX()) : Amount(path.normalized())));
}

modeling::Command SelectTool::command(const Motion& motion, const Amount& amount) const {
  modeling::MovePoints move{motion.points, modeling::MoveBy{amount}, motion.reach};
  if (motion.axis == GizmoAxis::kNormal) move.how = modeling::MoveAlongNormal{amount.x()};
  return move;
}

QString SelectTool::describe(const Motion& motion) const {
  const auto length = [&](double value) { return shown(value, Quantity::kLength, units(), 4); };
  if (motion.axis == GizmoAxis::kAll) return length(motion.amount.norm());
  const double distance = motion.axis == GizmoAxis::kNormal
                              ? motion.amount.x()
                              : motion.amount.dot(directionOf(motion));
  return axisName(motion) + " " + length(distance);
}

QString SelectTool::hint() const {
  if (isMoving())
    return tr(
        "Moving: X, Y, Z or N restricts it to an axis or the normal; digits set the distance; "
        "Ctrl rounds; Enter confirms, Escape cancels");
  return tr(
      "Click or box to select, Shift adds, Ctrl removes; drag or press G to move; arrow keys "
      "nudge");
}

}  // namespace palpa::gui
