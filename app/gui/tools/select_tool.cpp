#include "app/gui/tools/select_tool.h"

#include <cmath>

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
  const double step = viewport.gridSpacing();
  if (motion.axis == GizmoAxis::kAll) {
    if (snap && motion.target) return Amount(motion.target->at - motion.place);
    Amount by = viewport.inViewPlane(motion.pixel, motion.place) -
                viewport.inViewPlane(motion.from, motion.place);
    // A coordinate that the drag leaves alone, as depth in a standard view, stays off the grid.
    const double still = 1e-9 * step;
    if (snap)
      for (Eigen::Index k = 0; k < 3; ++k)
        if (std::abs(by[k]) > still)
          by[k] = snapped(motion.place[k] + by[k], step) - motion.place[k];
    return by;
  }
  const Eigen::Vector3d direction = directionOf(motion);
  const auto from = viewport.onLine(motion.from, motion.place, direction);
  const auto to = viewport.onLine(motion.pixel, motion.place, direction);
  if (!from || !to) return std::nullopt;
  const double distance = direction.dot(*to - *from);
  if (!snap) return along(motion, direction, distance);
  if (motion.target)
    return along(motion, direction, direction.dot(motion.target->at - motion.place));
  // Along normals and gradients there is no grid: the distance is rounded.
  const bool hasGrid = motion.axis != GizmoAxis::kNormal && motion.axis != GizmoAxis::kGradient;
  const double start = hasGrid ? direction.dot(motion.place) : 0;
  return along(motion, direction, snapped(start + distance, step) - start);
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
  QString target;
  if (motion.snaps && motion.typed.isEmpty()) {
    target = tr("grid %1").arg(length(workspace_.view.viewport().gridSpacing()));
    if (motion.target)
      target =
          motion.target->kind == SnapTarget::Kind::kPoint ? tr("on a point") : tr("on an edge");
    target.prepend("   ");
  }
  if (motion.axis == GizmoAxis::kAll) {
    // The unit once, behind the last number.
    const double noise = 1e-6 * motion.amount.norm();
    const auto number = [&](double value) {
      return length(std::abs(value) < noise ? 0 : value).section(' ', 0, 0);
    };
    return QString("dx %1   dy %2   dz %3   d %4")
               .arg(number(motion.amount.x()), number(motion.amount.y()), number(motion.amount.z()),
                    length(motion.amount.norm())) +
           target;
  }
  const double distance = motion.axis == GizmoAxis::kNormal
                              ? motion.amount.x()
                              : motion.amount.dot(directionOf(motion));
  return axisName(motion) + " " + length(distance) + target;
}

QString SelectTool::hint() const {
  if (isMoving())
    return tr(
        "Moving: X, Y, Z, N or K restricts it to an axis, the normal or the arrow of the stiffness "
        "gradient; digits set the distance; Ctrl snaps; Enter confirms, Escape cancels");
  return tr(
      "Click or box to select, Shift adds, Ctrl removes; drag or press G to move; arrow keys "
      "nudge");
}

}  // namespace palpa::gui
