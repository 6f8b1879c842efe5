#pragma once

#include "app/gui/simulate/samples.h"
#include "app/gui/view/tool.h"

namespace palpa::gui {

/// Shows all fields at the point under the pointer; a click pins them.
class SampleTool : public Tool {
  Q_OBJECT

 public:
  SampleTool(Simulation& simulation, Samples& samples, ViewportWidget& widget);

  void deactivate() override;
  bool press(const PointerEvent& event) override;
  bool move(const PointerEvent& event) override;
  void leave() override;
  bool wantsKey(const QKeyEvent& event) const override;
  bool key(QKeyEvent* event) override;
  QCursor cursor() const override { return Qt::CrossCursor; }
  QString hint() const override;
  KeyHelp keyHelp() const override;

 private:
  Simulation& simulation_;
  Samples& samples_;
  ViewportWidget& widget_;
  Eigen::Vector2d pointer_ = Eigen::Vector2d::Zero();
};

}  // namespace palpa::gui
