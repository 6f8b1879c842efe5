#pragma once

#include <Eigen/Core>
#include <optional>

#include "app/gui/document/editor.h"
#include "app/gui/view/scene_controller.h"
#include "app/gui/tools/point_options.h"
#include "app/gui/view/pointer_event.h"
#include "app/gui/view/viewport_widget.h"

namespace palpa::gui {

/// Pixels the pointer goes before a press becomes a drag.
inline constexpr double kDragThreshold = 3;

/// Selects control points, patches or edges, as the options say: by clicks, Shift adding and
/// removing, and by a box, Shift adding and Ctrl removing. A box takes patches and edges whose
/// points all lie in it. Faces are what can be selected of a mesh body.
class PointPicker {
 public:
  PointPicker(Editor& editor, SceneController& scene, ViewportWidget& widget,
              PointOptions& options);

  /// Highlights what a click would select.
  void hover(const Eigen::Vector2d& pixel);
  void unhover();
  std::optional<int> hoveredEdge() const { return hoveredEdge_; }

  /// What is selected when what lies under the pixel is, alone or, with `toggle`, added to the
  /// selection or removed from it. Nothing when nothing lies there.
  std::optional<Selection> clicked(const Eigen::Vector2d& pixel, bool toggle) const;
  /// Is what lies under the pixel selected already?
  bool isSelectedAt(const Eigen::Vector2d& pixel) const;
  /// The place of the point under the pixel; nothing in the other modes.
  std::optional<Eigen::Vector3d> pointPlaceAt(const Eigen::Vector2d& pixel) const;

  /// A press that may become a box; a click when the pointer stays.
  void beginBox(const Eigen::Vector2d& pixel) { boxFrom_ = pixel; }
  bool isInBox() const { return boxFrom_.has_value(); }
  void stretchBox(const Eigen::Vector2d& pixel);
  void endBox(const PointerEvent& event);
  void cancelBox();

  /// Selects the points of the patch under the pixel; with `add` in addition. False when there is
  /// none.
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
