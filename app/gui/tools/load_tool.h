#pragma once

#include "app/gui/tools/surface_tool.h"

namespace palpa::gui {

/// Places loads: a pressure or a uniform traction on clicked patches, or a bump: a press sets its
/// centre, a drag its radius. Patches go to the selected load of the chosen kind, or to a new load.
class LoadTool : public SurfaceTool {
  Q_OBJECT

 public:
  /// In the order of the alternatives of Load::what.
  enum class LoadKind { kPressure, kTraction, kBump };

  using SurfaceTool::SurfaceTool;

  bool press(const PointerEvent& event) override;
  bool move(const PointerEvent& event) override;
  bool release(const PointerEvent& event) override;
  bool cancel() override;
  QCursor cursor() const override { return Qt::CrossCursor; }
  QString hint() const override;
  QWidget* makeOptions(QWidget* parent) override;

  LoadKind kind() const { return kind_; }
  void setKind(LoadKind kind);

  /// Strength of the selected load of this kind, or of the next one, MPa; for a bump its peak.
  double strength() const;
  void setStrength(double strength);
  Eigen::Vector3d traction() const;
  void setTraction(const Eigen::Vector3d& traction);
  /// Radius of the selected bump, or of a bump placed by a click, mm.
  double radius() const;
  void setRadius(double radius);

 private:
  const modeling::Load* target() const;
  void change(const modeling::Load& load);
  void clickPatch(int patch);
  void placeBump();
  double defaultStrength() const;
  void hover(const Eigen::Vector2d& pixel);
  void drawBump();

  LoadKind kind_ = LoadKind::kPressure;
  std::optional<double> strength_;           // MPa; default: a share of Young's modulus
  std::optional<Eigen::Vector3d> traction_;  // MPa; default as for strength_
  std::optional<double> radius_;             // mm; default: a share of the body's size
  std::optional<SurfacePlace> centre_;       // centre of the dragged bump
  double dragged_ = 0;                       // radius of the dragged bump, mm; 0 before the drag
  Eigen::Vector2d pressed_ = Eigen::Vector2d::Zero();
};

}  // namespace palpa::gui
