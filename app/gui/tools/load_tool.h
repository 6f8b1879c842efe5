#pragma once

#include "app/gui/tools/surface_tool.h"

namespace palpa::gui {

/// Places loads: a pressure or a uniform traction on patches, or a bump, whose centre is pressed
/// and whose radius is dragged. The selected load of the chosen kind gets the patches; without one,
/// a new load.
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

  /// Of the selected load of this kind, or of the next one. MPa; the peak of a bump.
  double strength() const;
  void setStrength(double strength);
  Eigen::Vector3d traction() const;
  void setTraction(const Eigen::Vector3d& traction);
  /// Of the selected bump, or of one placed by a click, mm.
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
  std::optional<double> strength_;           // MPa; a share of Young's modulus until it is set
  std::optional<Eigen::Vector3d> traction_;  // MPa, likewise
  std::optional<double> radius_;             // mm; a share of the body's size until it is set
  std::optional<SurfacePlace> centre_;       // of the bump being dragged
  double dragged_ = 0;                       // its radius; 0 before the drag
  Eigen::Vector2d pressed_ = Eigen::Vector2d::Zero();
};

}  // namespace palpa::gui
