#pragma once

#include <optional>

#include "app/gui/base/settings.h"
#include "app/gui/simulate/section_view.h"
#include "app/gui/view/tool.h"

namespace palpa::gui {

/// Moves the section plane of Simulate mode: a drag along its normal, keys for the normal, numbers
/// in the Properties panel. The plane stays when another tool is chosen.
class SectionTool : public Tool {
  Q_OBJECT

 public:
  SectionTool(Settings& settings, Simulation& simulation, SectionView& section,
              ViewportWidget& widget);

  void activate() override;
  void deactivate() override;
  bool press(const PointerEvent& event) override;
  bool move(const PointerEvent& event) override;
  bool release(const PointerEvent& event) override;
  bool wantsKey(const QKeyEvent& event) const override;
  bool key(QKeyEvent* event) override;
  bool cancel() override;
  QCursor cursor() const override;
  QString hint() const override;
  KeyHelp keyHelp() const override;
  QWidget* makeOptions(QWidget* parent) override;

 private:
  void draw();
  void choose(const Eigen::Vector3d& axis);
  void alongView();

  struct Drag {
    modeling::Plane before;
    Eigen::Vector3d through;  ///< mm, at rest
    Eigen::Vector2d from;
  };
  Settings& settings_;
  Simulation& simulation_;
  SectionView& section_;
  ViewportWidget& widget_;
  std::optional<Drag> drag_;
  bool isActive_ = false;
};

}  // namespace palpa::gui
