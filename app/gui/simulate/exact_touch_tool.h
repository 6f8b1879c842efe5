#pragma once

#include "app/gui/simulate/exact_touch.h"
#include "app/gui/view/tool.h"
#include "app/gui/view/viewport_widget.h"

namespace palpa::gui {

/// Touches the solid by numbers in Simulate mode: a click chooses the place, fields of the
/// Properties panel the rest.
class ExactTouchTool : public Tool {
  Q_OBJECT

 public:
  ExactTouchTool(const Workspace& workspace, Simulation& simulation, SimulateOptions& options);

  void activate() override;
  void deactivate() override;
  bool press(const PointerEvent& event) override;
  bool release(const PointerEvent& event) override;
  bool move(const PointerEvent& event) override;
  void leave() override;
  /// Ends the applied touch; without one, all pins.
  bool cancel() override;
  QCursor cursor() const override { return Qt::CrossCursor; }
  QString hint() const override;
  KeyHelp keyHelp() const override;
  QWidget* makeOptions(QWidget* parent) override;

 private:
  void draw(const std::optional<Eigen::Vector3d>& hovered = {});
  void openSweep();

  Workspace workspace_;
  Simulation& simulation_;
  ExactTouch touch_;
  bool isActive_ = false;
};

}  // namespace palpa::gui
