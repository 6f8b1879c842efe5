#pragma once

#include "app/gui/tools/surface_tool.h"
#include "modeling/solid/knot_operations.h"

namespace palpa::gui {

/// Removes knots: highlights the knot line nearest to the pointer, shows how far the surface would
/// move without it, and removes it on a click if this is within the tolerance.
class RemoveKnotTool : public SurfaceTool {
  Q_OBJECT

 public:
  RemoveKnotTool(Settings& settings, Editor& editor, SceneController& scene,
                 ViewportWidget& widget);

  bool press(const PointerEvent& event) override;
  bool move(const PointerEvent& event) override;
  void leave() override;
  QCursor cursor() const override { return Qt::CrossCursor; }
  QString hint() const override;
  QWidget* makeOptions(QWidget* parent) override;

  /// Largest allowed motion of the surface, mm.
  double tolerance() const;
  void setTolerance(double tolerance);

 private:
  struct Knot {
    modeling::PatchDirection at;
    double parameter = 0;
    bool operator==(const Knot& other) const {
      return at.patch == other.at.patch && at.direction == other.at.direction &&
             parameter == other.parameter;
    }
  };
  std::optional<Knot> knotAt(const Eigen::Vector2d& pixel) const;
  void hover(const Eigen::Vector2d& pixel);
  void findConsequence();

  std::optional<double> tolerance_;  // mm; default: a share of the body's size
  std::optional<Knot> hovered_;
  std::optional<double> deviation_;  // of its removal, mm; nothing if impossible
  QString refusal_;                  // reason if it cannot be removed
};

}  // namespace palpa::gui
