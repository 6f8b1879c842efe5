#pragma once

#include "app/gui/tools/point_tool.h"

namespace palpa::gui {

/// Selects points and moves them: parallel to the screen, along an axis, or each point along its
/// outward normal.
class SelectTool : public PointTool {
  Q_OBJECT

 public:
  using PointTool::PointTool;
  QString hint() const override;

 protected:
  view::GizmoKind kind() const override { return view::GizmoKind::kMove; }
  bool allows(view::GizmoAxis) const override { return true; }
  Amount neutral() const override { return Amount::Zero(); }
  std::optional<Amount> pointed(const Motion& motion, bool snap) const override;
  std::optional<Amount> entered(const Motion& motion, const QString& text) const override;
  std::optional<Amount> between(const Amount& from, const Amount& to) const override {
    return Amount(to - from);
  }
  modeling::Command command(const Motion& motion, const Amount& amount) const override;
  QString describe(const Motion& motion) const override;

 private:
  static Amount along(const Motion& motion, const Eigen::Vector3d& direction, double distance);
};

}  // namespace palpa::gui
