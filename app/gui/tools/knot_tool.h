#pragma once

#include "app/gui/tools/surface_tool.h"
#include "modeling/solid/knot_operations.h"

namespace palpa::gui {

/// Inserts knots: shows the new lines on all patches that share the knot, and inserts them on a
/// click. Tab (or pressed Shift) switches between lines of constant u and v, Ctrl takes the middle
/// of the span.
class KnotTool : public SurfaceTool {
  Q_OBJECT

 public:
  using SurfaceTool::SurfaceTool;

  bool press(const PointerEvent& event) override;
  bool move(const PointerEvent& event) override;
  bool key(QKeyEvent* event) override;
  bool wantsKey(const QKeyEvent& event) const override;
  void leave() override;
  QCursor cursor() const override { return Qt::CrossCursor; }
  QString hint() const override;
  QWidget* makeOptions(QWidget* parent) override;

  /// 0: lines of constant u; 1: of constant v.
  int direction() const { return direction_; }
  void setDirection(int direction);

 private:
  std::vector<KeyHelp::Row> keyRows() const override;
  struct Knot {
    modeling::PatchDirection at;
    double parameter = 0;
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
  };
  std::optional<Knot> knotAt(const Eigen::Vector2d& pixel, Qt::KeyboardModifiers modifiers) const;
  void hover();

  int direction_ = 0;
  std::optional<Eigen::Vector2d> last_;  // pixel
  Qt::KeyboardModifiers modifiers_ = Qt::NoModifier;
};

}  // namespace palpa::gui
