#pragma once

#include <array>

#include "app/gui/document/load_kinds.h"
#include "app/gui/tools/surface_tool.h"

namespace palpa::gui {

/// Places loads: on clicked patches; a bump by a press at its centre and a drag of its radius;
/// gravity by a click on the body. Patches go to the selected load of the chosen kind, or to a new
/// load.
class LoadTool : public SurfaceTool {
  Q_OBJECT

 public:
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
  /// Vector of the selected load of this kind, or of the next one; zero for kinds without one.
  Eigen::Vector3d vector() const;
  void setVector(const Eigen::Vector3d& vector);
  /// Radius of the selected bump, or of a bump placed by a click, mm.
  double radius() const;
  void setRadius(double radius);
  /// The selected load of this kind; null without one.
  const modeling::Load* target() const;
  /// Takes the kind of the selected load, if any.
  void followSelection();
  /// Selects the gravity of the project, or adds it with the acceleration of the options.
  void placeGravity();

 private:
  /// The next new load of this kind, without name and region.
  modeling::Load next() const;
  void change(const modeling::Load& load);
  void clickPatch(int patch);
  void placeBump();
  void hover(const Eigen::Vector2d& pixel);
  void drawBump();

  LoadKind kind_ = LoadKind::kPressure;
  std::optional<double> strength_;                                      // MPa; default: usualLoad()
  std::array<std::optional<Eigen::Vector3d>, kLoadKindCount> vectors_;  // by kind, as strength_
  std::optional<double> radius_;                                        // mm; as strength_
  std::optional<SurfacePlace> centre_;  // centre of the dragged bump
  double dragged_ = 0;                  // radius of the dragged bump, mm; 0 before the drag
  Eigen::Vector2d pressed_ = Eigen::Vector2d::Zero();
};

}  // namespace palpa::gui
