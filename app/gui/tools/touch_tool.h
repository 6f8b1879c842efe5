#pragma once

#include "app/gui/tools/surface_tool.h"

namespace palpa::gui {

/// Places recorded touches: press on the surface and pull the displacement out, parallel to the
/// screen or along the normal (Ctrl, or N to keep it). A click presses a little into the body.
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

  /// How far a click presses inwards, mm.
  double depth() const;
  void setDepth(double depth);

 private:
  void pull(const Eigen::Vector2d& pixel, bool alongNormal);
  void drawTouch(const SurfacePlace& place, const Eigen::Vector3d& vector);

  std::optional<double> depth_;  // mm; a share of the body's size until it is set
  std::optional<SurfacePlace> place_;
  Eigen::Vector3d vector_ = Eigen::Vector3d::Zero();
  Eigen::Vector2d pressed_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d last_ = Eigen::Vector2d::Zero();
  bool isDragged_ = false;
  bool alongNormal_ = false;
};

}  // namespace palpa::gui
