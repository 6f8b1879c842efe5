#pragma once

#include <optional>
#include <vector>

#include "app/gui/base/settings.h"
#include "app/gui/simulate/simulate_options.h"
#include "app/gui/simulate/simulation.h"
#include "app/gui/view/tool.h"
#include "app/gui/view/viewport_widget.h"

namespace palpa::gui {

/// The hand in Simulate mode: a press begins a contact, dragging moves it parallel to the screen,
/// or along the normal of its place with Ctrl or the wheel; release lets go, with Shift it stays as
/// a pin. A press on a pin takes hold of it again.
class SimulateTool : public Tool {
  Q_OBJECT

 public:
  using Kind = bem::ContactTool::Kind;
  SimulateTool(Kind kind, Settings& settings, Simulation& simulation, SimulateOptions& options,
           ViewportWidget& widget);

  void deactivate() override;
  bool press(const PointerEvent& event) override;
  bool move(const PointerEvent& event) override;
  bool release(const PointerEvent& event) override;
  bool doubleClick(const PointerEvent& event) override;
  bool wheel(const PointerEvent& event, double notches) override;
  void leave() override;
  /// Delete lets go of the pin under the pointer; never of a support or load that was selected
  /// while modelling, which is not seen here.
  bool wantsKey(const QKeyEvent& event) const override;
  bool key(QKeyEvent* event) override;
  /// Lets go of what is held; otherwise of all pins.
  bool cancel() override;
  QCursor cursor() const override;
  QString hint() const override;
  QWidget* makeOptions(QWidget* parent) override;

 private:
  /// Place, on the unloaded shape and as it is drawn, and normal under a pixel.
  struct Place {
    Eigen::Vector3d at, drawn, normal;
  };
  std::optional<Place> placeAt(const Eigen::Vector2d& pixel) const;
  std::optional<app::TouchId> pinAt(const Eigen::Vector2d& pixel) const;
  void pull(const Eigen::Vector2d& pixel, bool alongNormal);
  /// Gives the contact the value of the motion so far.
  void follow();
  void drawHover(const Eigen::Vector2d& pixel);

  /// What is held.
  struct Hold {
    app::TouchId id = 0;
    Kind kind{};
    double gain = 1;         // value per mm that the place moves
    double scale = 1;        // that displacements are drawn with
    Eigen::Vector3d start;   // value before any motion
    Eigen::Vector3d place;   // mm, where it is drawn: the plane of the motion
    Eigen::Vector3d normal;  // unit, outwards
    Eigen::Vector2d from;    // pixel of the last change of direction
    Eigen::Vector3d done;    // mm, motion before `from`
    Eigen::Vector3d motion;  // mm, so far
    bool alongNormal = false;
  };

  Kind kind_;
  Settings& settings_;
  Simulation& simulation_;
  SimulateOptions& options_;
  ViewportWidget& widget_;
  std::optional<Hold> hold_;
  Eigen::Vector2d pointer_ = Eigen::Vector2d::Zero();  // pixel
  int pins_ = 0;                                       // as the hint has them
};

}  // namespace palpa::gui
