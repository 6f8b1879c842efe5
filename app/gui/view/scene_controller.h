#pragma once

#include <QObject>
#include <memory>
#include <optional>
#include <set>

#include "app/gui/document/editor.h"
#include "app/gui/base/settings.h"
#include "app/gui/view/surface_place.h"
#include "app/gui/view/viewport_widget.h"
#include "modeling/solid/tessellation.h"

namespace palpa::gui {

/// Keeps the view in step with the editor: the surface and the control net follow every edit at
/// once, marks and arrows show supports and loads, handles show the selection.
class SceneController : public QObject {
  Q_OBJECT

 public:
  SceneController(Editor& editor, const Settings& settings, ViewportWidget& widget);

  /// While it is not shown the view belongs to others: what changes then is drawn when it is shown
  /// again.
  void setShown(bool shown);

  /// The control point under the pointer, highlighted.
  void setHovered(std::optional<int> point);
  void setGizmoAxis(view::GizmoAxis axis);
  /// Which handles stand in the middle of what is selected; none: no handles.
  void setGizmoKind(std::optional<view::GizmoKind> kind);
  /// Points drawn as going along with the selection.
  void setFollowing(std::set<int> points);
  /// The patch under the pointer, highlighted.
  void setHoveredPatch(std::optional<int> patch);

  /// Points that show all that is selected in the view.
  std::vector<Eigen::Vector3d> selectedPlaces() const;
  /// Middle of the points that a motion of the selection moves; nothing when there is none.
  std::optional<Eigen::Vector3d> selectionCentre() const;

  /// What lies under a device pixel of the view.
  std::optional<SurfacePlace> placeAt(const Eigen::Vector2d& pixel) const;
  /// The triangles the view shows.
  ShownSurface surface() const;
  /// The patch (or the face of a mesh body) under a pixel.
  std::optional<int> patchAt(const Eigen::Vector2d& pixel) const;
  /// The edge of the solid near a pixel: an index of Solid::edges().
  std::optional<int> edgeAt(const Eigen::Vector2d& pixel) const;
  /// Points along an edge as it is drawn.
  std::vector<Eigen::Vector3d> edgeLine(int edge) const;

 private:
  void showProject();
  void showChange(const modeling::Change& change);
  void showMeshBody();
  void showSelection();
  void showRegions();
  void showMarks();
  void showLoads();
  void showTouches();
  void setPatches(const std::vector<view::Triangle>& triangles,
                  const std::vector<int>& patchOfTriangle);

  Editor& editor_;
  const Settings& settings_;
  ViewportWidget& widget_;
  std::unique_ptr<modeling::Tessellation> tessellation_;
  modeling::Tessellation::Shape shape_;  // as shown
  std::vector<int> patchOfTriangle_, patchOfPosition_;
  bool isShown_ = true;
  std::optional<int> hovered_;
  std::optional<int> hoveredPatch_;
  std::set<int> following_;
  std::set<int> markedPatches_;  // as selected
  std::size_t netSize_ = 0;      // control points the view has
  view::GizmoAxis axis_ = view::GizmoAxis::kNone;
  std::optional<view::GizmoKind> gizmoKind_;
};

}  // namespace palpa::gui
