#pragma once

#include "app/gui/simulate/samples.h"
#include "app/gui/view/tool.h"

namespace palpa::gui {

/// Shows all fields at the point under the pointer; a click pins them, a drag moves a pin.
class SampleTool : public Tool {
  Q_OBJECT

 public:
  SampleTool(Simulation& simulation, Samples& samples, ViewportWidget& widget);

  void deactivate() override;
  bool press(const PointerEvent& event) override;
  bool move(const PointerEvent& event) override;
  bool release(const PointerEvent& event) override;
  /// Puts a dragged pin back.
  bool cancel() override;
  void leave() override;
  bool wantsKey(const QKeyEvent& event) const override;
  bool followsPointer() const override { return false; }
  bool key(QKeyEvent* event) override;
  QCursor cursor() const override { return drag_ ? Qt::ClosedHandCursor : Qt::CrossCursor; }
  QString hint() const override;
  KeyHelp keyHelp() const override;

 private:
  Simulation& simulation_;
  Samples& samples_;
  ViewportWidget& widget_;
  struct Drag {
    int pin;
    Samples::Pin before;
    Eigen::Vector2d from;   // pixel of the press
    bool hasBegun = false;  // the pointer has left the neighbourhood of the press
  };
  std::optional<Drag> drag_;
};

}  // namespace palpa::gui
