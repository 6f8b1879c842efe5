#pragma once

#include <optional>
#include <vector>

#include "app/gui/base/settings.h"
#include "app/gui/simulate/simulate_options.h"
#include "app/gui/simulate/simulation.h"
#include "app/gui/simulate/surface_pick.h"
#include "app/gui/view/tool.h"
#include "app/gui/view/viewport_widget.h"

namespace palpa::gui {

/// Touches the body in Simulate mode: a press begins a contact, a drag moves it parallel to the
/// screen, or along the normal with Ctrl or the wheel. A release ends the contact; with Shift it
/// stays as a pin. A pin can be dragged again.
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
  /// Takes Delete, which removes the pin under the pointer and must not delete a support or load
  /// that is still selected from modelling.
  bool wantsKey(const QKeyEvent& event) const override;
  bool key(QKeyEvent* event) override;
  /// Ends the dragged contact; without one, all pins.
  bool cancel() override;
  QCursor cursor() const override;
  QString hint() const override;
  KeyHelp keyHelp() const override;
  QWidget* makeOptions(QWidget* parent) override;

 private:
  std::optional<SurfacePick> placeAt(const Eigen::Vector2d& pixel) const;
  std::optional<app::TouchId> pinAt(const Eigen::Vector2d& pixel) const;
  void pull(const Eigen::Vector2d& pixel, bool alongNormal);
  /// Sets the value of the contact from the present motion.
  void follow();
  void drawHover(const Eigen::Vector2d& pixel);

  /// The dragged contact.
  struct Drag {
    app::TouchId id = 0;
    Kind kind{};
    double gain = 1;         // value per mm of motion
    double scale = 1;        // factor of drawn displacements
    Eigen::Vector3d start;   // value at the start
    Eigen::Vector3d place;   // mm, as drawn: point of the plane of motion
    Eigen::Vector3d normal;  // unit, outwards
    Eigen::Vector2d from;    // pixel of the last change of direction
    Eigen::Vector3d done;    // mm, motion up to `from`
    Eigen::Vector3d motion;  // mm, present
    bool alongNormal = false;
  };

  Kind kind_;
  Settings& settings_;
  Simulation& simulation_;
  SimulateOptions& options_;
  ViewportWidget& widget_;
  std::optional<Drag> drag_;
  Eigen::Vector2d pointer_ = Eigen::Vector2d::Zero();  // pixel
  int pins_ = 0;                                       // number in the present hint
};

}  // namespace palpa::gui
