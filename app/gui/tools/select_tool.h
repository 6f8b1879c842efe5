#pragma once

#include <Eigen/Core>
#include <optional>
#include <set>

#include "app/gui/editor.h"
#include "app/gui/scene_controller.h"
#include "app/gui/tools/tool.h"
#include "app/gui/viewport_widget.h"

namespace palpa::gui {

/// Selects control points (click, Shift to add or remove, box) and drags them: freely parallel to
/// the screen, or along an axis by the gizmo. One drag is one step of undo; Escape takes it back.
class SelectTool : public Tool {
 public:
  SelectTool(Editor& editor, SceneController& scene, ViewportWidget& widget);

  bool press(const PointerEvent& event) override;
  bool move(const PointerEvent& event) override;
  bool release(const PointerEvent& event) override;
  void leave() override { scene_.setHovered(std::nullopt); }
  bool cancel() override;
  QCursor cursor() const override;
  QString hint() const override;

 private:
  enum class Mode { kNone, kDrag, kBox };
  std::optional<Eigen::Vector3d> dragTarget(const Eigen::Vector2d& pixel) const;
  void drag(const Eigen::Vector2d& pixel);

  Editor& editor_;
  SceneController& scene_;
  ViewportWidget& widget_;
  Mode mode_ = Mode::kNone;
  view::GizmoAxis axis_ = view::GizmoAxis::kNone;
  Eigen::Vector2d pressed_ = Eigen::Vector2d::Zero();
  Eigen::Vector3d start_ = Eigen::Vector3d::Zero();  // of the dragged point or the gizmo
  Eigen::Vector3d grip_ = Eigen::Vector3d::Zero();   // what lay under the pointer at the start
  Eigen::Vector3d moved_ = Eigen::Vector3d::Zero();  // by the drag so far
  bool hasMoved_ = false;
};

}  // namespace palpa::gui
