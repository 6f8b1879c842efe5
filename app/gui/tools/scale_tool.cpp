#include "app/gui/tools/scale_tool.h"

#include "app/gui/tools/motion_geometry.h"

namespace palpa::gui {
namespace {

constexpr double kFactorStep = 0.1;  // with Ctrl

}  // namespace

ScaleTool::Amount ScaleTool::along(const Motion& motion, double factor) {
  Amount factors = Amount::Constant(factor);
  if (motion.axis != view::GizmoAxis::kAll) {
    factors = Amount::Ones();
    const int axis = motion.axis == view::GizmoAxis::kX   ? 0
                     : motion.axis == view::GizmoAxis::kY ? 1
                                                          : 2;
    factors[axis] = factor;
  }
  return factors;
}

std::optional<ScaleTool::Amount> ScaleTool::pointed(const Motion& motion, bool snap) const {
  const Eigen::Vector2d centre = workspace_.view.viewport().toPixel(motion.centre);
  if (!centre.allFinite()) return std::nullopt;
  const double factor = factorFrom(centre, motion.from, motion.pixel);
  return along(motion, snap ? snapped(factor, kFactorStep) : factor);
}

std::optional<ScaleTool::Amount> ScaleTool::entered(const Motion& motion,
                                                    const QString& text) const {
  const auto factor = parsed(text, Quantity::kNumber, units());
  if (!factor) return std::nullopt;
  return along(motion, *factor);
}

std::optional<ScaleTool::Amount> ScaleTool::between(const Amount& from, const Amount& to) const {
  if ((from.array() == 0.0).any()) return std::nullopt;  // flat: cannot be reversed
  return Amount(to.cwiseQuotient(from));
}

modeling::Command ScaleTool::command(const Motion& motion, const Amount& amount) const {
  return modeling::ScalePoints{motion.points, amount, motion.centre, motion.reach};
}

QString ScaleTool::describe(const Motion& motion) const {
  const Amount& factors = motion.amount;
  const double factor = motion.axis == view::GizmoAxis::kY   ? factors.y()
                        : motion.axis == view::GizmoAxis::kZ ? factors.z()
                                                             : factors.x();
  return (axisName(motion) + " × " + QString::number(factor, 'g', 4)).trimmed();
}

QString ScaleTool::hint() const {
  if (isMoving())
    return tr(
        "Scaling: X, Y or Z restricts it to an axis; digits set the factor; Ctrl rounds to 0.1; "
        "Enter confirms, Escape cancels");
  return tr(
      "Drag the selection or a handle to scale it; or press G, X, Y or Z, then type a "
      "factor");
}

}  // namespace palpa::gui
