#pragma once

#include <Eigen/Core>
#include <optional>

#include "app/gui/document/editor.h"
#include "app/gui/tools/point_options.h"
#include "app/gui/view/pointer_event.h"
#include "app/gui/view/scene_controller.h"
#include "app/gui/view/viewport_widget.h"

namespace palpa::gui {

/// Selects control points, patches or edges, depending on the options: by clicks (Shift adds or
/// removes) and by a box (Shift adds, Ctrl removes). A box selects patches and edges that have all
/// their points in the box. A mesh body has only faces to select.
class PointPicker {
 public:
  PointPicker(Editor& editor, SceneController& scene, ViewportWidget& widget,
              PointOptions& options);

  /// Highlights the target of a click.
  void hover(const Eigen::Vector2d& pixel);
  void unhover();
  std::optional<int> hoveredEdge() const { return hoveredEdge_; }

  /// Selection after a click: the item under the pixel; with `toggle` added to or removed from the
  /// present selection. Nothing without an item there.
  std::optional<Selection> clicked(const Eigen::Vector2d& pixel, bool toggle) const;
  /// True if the item under the pixel is selected.
  bool isSelectedAt(const Eigen::Vector2d& pixel) const;
  /// Position of the control point under the pixel; nothing if patches or edges are picked.
  std::optional<Eigen::Vector3d> pointPlaceAt(const Eigen::Vector2d& pixel) const;

  /// Begins a box; it becomes a click if the pointer does not move.
  void beginBox(const Eigen::Vector2d& pixel) { boxFrom_ = pixel; }
  bool isInBox() const { return boxFrom_.has_value(); }
  void stretchBox(const Eigen::Vector2d& pixel);
  void endBox(const PointerEvent& event);
  void cancelBox();

  /// Selects the points of the patch under the pixel, or adds them with `add`. False without a
  /// patch.
  bool selectPointsOfPatchAt(const Eigen::Vector2d& pixel, bool add);

 private:
  PointOptions::Pick pick() const;
  std::optional<int> at(const Eigen::Vector2d& pixel) const;
  static std::set<int>& partOf(Selection& selection, PointOptions::Pick pick);
  std::set<int> inBox(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const;

  Editor& editor_;
  SceneController& scene_;
  ViewportWidget& widget_;
  PointOptions& options_;
  std::optional<Eigen::Vector2d> boxFrom_;
  std::optional<int> hoveredEdge_;
};

}  // namespace palpa::gui
