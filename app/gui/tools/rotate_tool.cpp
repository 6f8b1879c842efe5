#include "app/gui/tools/rotate_tool.h"

#include "app/gui/tools/motion_geometry.h"

namespace palpa::gui {
namespace {

constexpr double kAngleStep = 15;  // degrees, with Ctrl

}  // namespace

std::optional<RotateTool::Amount> RotateTool::pointed(const Motion& motion, bool snap) const {
  // The pointer rotates the visible side: about an axis that points away the sign is opposite.
  const auto [right, up] = screenAxes();
  const double degrees =
      directionOf(motion).dot(right.cross(up)) < 0 ? -motion.turned : motion.turned;
  return Amount(snap ? snapped(degrees, kAngleStep) : degrees, 0, 0);
}

std::optional<RotateTool::Amount> RotateTool::entered(const Motion&, const QString& text) const {
  const auto degrees = parsed(text, Quantity::kNumber, units());
  if (!degrees) return std::nullopt;
  return Amount(*degrees, 0, 0);
}

std::optional<RotateTool::Amount> RotateTool::between(const Amount& from, const Amount& to) const {
  return Amount(to - from);
}

modeling::Command RotateTool::command(const Motion& motion, const Amount& amount) const {
  return modeling::RotatePoints{motion.points, directionOf(motion), amount.x(), motion.centre,
                                motion.reach};
}

QString RotateTool::describe(const Motion& motion) const {
  return (axisName(motion) + " " + QString::number(motion.amount.x(), 'f', 1) + "°").trimmed();
}

QString RotateTool::hint() const {
  if (isMoving())
    return tr(
        "Rotating: X, Y, Z or N chooses the axis; digits set degrees; Ctrl rounds to 15°; "
        "Enter confirms, Escape cancels");
  return tr("Drag the selection or a ring to rotate it; or press G, X, Y or Z, then type degrees");
}

}  // namespace palpa::gui
