#pragma once

#include "app/gui/tools/point_tool.h"

namespace palpa::gui {

/// Scales points about their mean, equally in all directions or along one axis.
class ScaleTool : public PointTool {
  Q_OBJECT

 public:
  using PointTool::PointTool;
  QString hint() const override;

 protected:
  view::GizmoKind kind() const override { return view::GizmoKind::kScale; }
  bool allows(view::GizmoAxis axis) const override {
    return axis != view::GizmoAxis::kNormal && axis != view::GizmoAxis::kGradient;
  }
  Amount neutral() const override { return Amount::Ones(); }
  std::optional<Amount> pointed(const Motion& motion, bool snap) const override;
  std::optional<Amount> entered(const Motion& motion, const QString& text) const override;
  std::optional<Amount> between(const Amount& from, const Amount& to) const override;
  modeling::Command command(const Motion& motion, const Amount& amount) const override;
  QString describe(const Motion& motion) const override;

 private:
  static Amount along(const Motion& motion, double factor);
};

}  // namespace palpa::gui
