#pragma once

#include "app/gui/tools/surface_tool.h"
#include "modeling/solid/knot_operations.h"

namespace palpa::gui {

/// Removes knots: highlights the knot line nearest to the pointer, says how far the surface would
/// move without it, and removes it on a click when that is within the tolerance.
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

  /// How far the surface may move, mm.
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

  std::optional<double> tolerance_;  // mm; a share of the body's size until it is set
  std::optional<Knot> hovered_;
  std::optional<double> deviation_;  // mm, of removing it; nothing when it cannot be removed
  QString refusal_;                  // then this says why
};

}  // namespace palpa::gui
