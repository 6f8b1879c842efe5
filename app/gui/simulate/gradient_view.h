#pragma once

#include <QObject>
#include <map>
#include <vector>

#include "app/gui/simulate/simulation.h"
#include "app/gui/view/viewport_widget.h"

namespace palpa::gui {

/// Arrows at the control points along the gradient of a touch's stiffness, with their legend, in
/// both modes; in Simulate mode on the deformed body. The touch is the one that was moved last.
/// Gives the colours of the gradient to the simulation.
class GradientView : public QObject {
  Q_OBJECT

 public:
  GradientView(Editor& editor, Simulation& simulation, const Settings& settings,
               ViewportWidget& widget);

  /// The arrows as drawn.
  const view::GradientDrawing& drawing() const { return drawing_; }

 private:
  void followTouch();
  void chooseContact();
  void colour();
  void draw();
  /// Places of all control points as drawn; empty if the gradient belongs to another net.
  std::vector<Eigen::Vector3d> places(const Eigen::Matrix3Xd& gradient);

  Editor& editor_;
  Simulation& simulation_;
  const Settings& settings_;
  ViewportWidget& widget_;
  app::TouchId contact_ = 0;
  std::map<app::TouchId, Eigen::Vector3d> values_;  // of the contacts in the last frame
  /// Points of the surface at rest nearest to the control points that have arrows, of `foundOn_`.
  std::map<int, bem::SurfacePoint> nearest_;
  std::shared_ptr<const app::DrawnBody> foundOn_;
  view::GradientDrawing drawing_;
};

}  // namespace palpa::gui
