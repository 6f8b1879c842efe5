#pragma once

#include <QObject>
#include <memory>
#include <optional>
#include <set>

#include "app/gui/base/settings.h"
#include "app/gui/document/editor.h"
#include "app/gui/view/dimension_view.h"
#include "app/gui/view/surface_place.h"
#include "app/gui/view/viewport_widget.h"
#include "modeling/solid/tessellation.h"

namespace palpa::gui {

/// Shows the project of the editor in the view: surface and control net follow every edit, marks
/// and arrows show supports and loads, handles show the selection.
class SceneController : public QObject {
  Q_OBJECT

 public:
  SceneController(Editor& editor, const Settings& settings, ViewportWidget& widget);

  /// Drawn part of the project. With kNothing other classes draw the view; changes of the project
  /// are drawn when the extent changes.
  enum class Extent {
    kAll,
    kBody,  ///< the body with its supports and loads, without points, selection and touches
    kNothing
  };
  void show(Extent extent);

  /// Highlights the control point under the pointer.
  void setHovered(std::optional<int> point);
  void setGizmoAxis(view::GizmoAxis axis);
  /// Kind of the handles at the centre of the selection; nothing: no handles.
  void setGizmoKind(std::optional<view::GizmoKind> kind);
  /// Points drawn as moving with the selection.
  void setFollowing(std::set<int> points);
  /// Highlights the patch under the pointer.
  void setHoveredPatch(std::optional<int> patch);

  DimensionView& dimensions() { return *dimensions_; }

  /// Points that enclose the selection in the view.
  std::vector<Eigen::Vector3d> selectedPlaces() const;
  /// Mean of the points that a motion of the selection moves; nothing without such points.
  std::optional<Eigen::Vector3d> selectionCentre() const;

  /// Surface place under a device pixel of the view.
  std::optional<SurfacePlace> placeAt(const Eigen::Vector2d& pixel) const;
  /// The drawn triangles.
  ShownSurface surface() const;
  /// Patch (or face of a mesh body) under a pixel.
  std::optional<int> patchAt(const Eigen::Vector2d& pixel) const;
  /// Edge of the solid near a pixel, as an index into Solid::edges().
  std::optional<int> edgeAt(const Eigen::Vector2d& pixel) const;
  /// Points along a drawn edge.
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
  void showConflict();
  void setPatches(const std::vector<view::Triangle>& triangles,
                  const std::vector<int>& patchOfTriangle);

  Editor& editor_;
  const Settings& settings_;
  ViewportWidget& widget_;
  DimensionView* dimensions_;  // owned by the widget
  std::unique_ptr<modeling::Tessellation> tessellation_;
  modeling::Tessellation::Shape shape_;  // as shown
  std::vector<int> patchOfTriangle_, patchOfPosition_;
  Extent extent_ = Extent::kAll;
  std::optional<app::SupportConflict> conflict_;  // as shown
  std::optional<int> hovered_;
  std::optional<int> hoveredPatch_;
  std::set<int> following_;
  std::set<int> markedPatches_;  // as selected
  std::size_t netSize_ = 0;      // control points the view has
  view::GizmoAxis axis_ = view::GizmoAxis::kNone;
  std::optional<view::GizmoKind> gizmoKind_;
};

}  // namespace palpa::gui
