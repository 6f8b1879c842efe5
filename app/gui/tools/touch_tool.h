#pragma once

#include "app/gui/tools/surface_tool.h"

namespace palpa::gui {

/// Places stored touches: a press on the surface sets the place, a drag the displacement, parallel
/// to the screen or along the normal (Ctrl, or N permanently). A click sets a small displacement
/// inwards; for a pin it sets none.
class TouchTool : public SurfaceTool {
  Q_OBJECT

 public:
  using SurfaceTool::SurfaceTool;

  bool press(const PointerEvent& event) override;
  bool move(const PointerEvent& event) override;
  bool release(const PointerEvent& event) override;
  bool key(QKeyEvent* event) override;
  bool wantsKey(const QKeyEvent& event) const override;
  bool cancel() override;
  QCursor cursor() const override { return Qt::CrossCursor; }
  QString hint() const override;
  QWidget* makeOptions(QWidget* parent) override;

  modeling::TouchKind kind() const { return kind_; }
  void setKind(modeling::TouchKind kind);
  /// Coulomb's coefficient of new touches that press.
  double friction() const { return friction_; }
  void setFriction(double friction) { friction_ = friction; }

  /// Displacement inwards of a click, mm.
  double depth() const;
  void setDepth(double depth);

 private:
  std::vector<KeyHelp::Row> keyRows() const override;
  void pull(const Eigen::Vector2d& pixel, bool alongNormal);
  void drawTouch(const SurfacePlace& place, const Eigen::Vector3d& vector);

  modeling::TouchKind kind_ = modeling::TouchKind::kGrab;
  double friction_ = 0;
  std::optional<double> depth_;  // mm; default: a share of the body's size
  std::optional<SurfacePlace> place_;
  Eigen::Vector3d vector_ = Eigen::Vector3d::Zero();
  Eigen::Vector2d pressed_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d last_ = Eigen::Vector2d::Zero();
  bool isDragged_ = false;
  bool alongNormal_ = false;
};

}  // namespace palpa::gui
