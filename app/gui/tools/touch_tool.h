#pragma once

#include "app/gui/tools/surface_tool.h"

namespace palpa::gui {

/// Places recorded touches: press on the surface and pull the displacement out, parallel to the
/// screen or along the normal (Ctrl, or N to keep it). A click presses a little into the body; that
/// of a pin holds the place.
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

  enum class Kind { kGrab, kPush, kProbe, kPin };
  Kind kind() const { return kind_; }
  void setKind(Kind kind);
  /// Coulomb's coefficient of new pushes and probes.
  double friction() const { return friction_; }
  void setFriction(double friction) { friction_ = friction; }

  /// How far a click presses inwards, mm.
  double depth() const;
  void setDepth(double depth);

 private:
  decltype(modeling::Touch::action) action() const;
  void pull(const Eigen::Vector2d& pixel, bool alongNormal);
  void drawTouch(const SurfacePlace& place, const Eigen::Vector3d& vector);

  Kind kind_ = Kind::kGrab;
  double friction_ = 0;
  std::optional<double> depth_;  // mm; a share of the body's size until it is set
  std::optional<SurfacePlace> place_;
  Eigen::Vector3d vector_ = Eigen::Vector3d::Zero();
  Eigen::Vector2d pressed_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d last_ = Eigen::Vector2d::Zero();
  bool isDragged_ = false;
  bool alongNormal_ = false;
};

}  // namespace palpa::gui
