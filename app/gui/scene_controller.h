#pragma once

#include <QObject>
#include <memory>
#include <optional>

#include "app/gui/editor.h"
#include "app/gui/surface_place.h"
#include "app/gui/viewport_widget.h"
#include "modeling/solid/tessellation.h"

namespace palpa::gui {

/// Keeps the view in step with the editor: the surface and the control net follow every edit at
/// once, marks and arrows show supports and loads, handles show the selection.
class SceneController : public QObject {
  Q_OBJECT

 public:
  SceneController(Editor& editor, ViewportWidget& widget);

  /// The control point under the pointer, highlighted.
  void setHovered(std::optional<int> point);
  void setGizmoAxis(view::GizmoAxis axis);
  /// The patch under the pointer, highlighted.
  void setHoveredPatch(std::optional<int> patch);

  /// What lies under a device pixel of the view.
  std::optional<SurfacePlace> placeAt(const Eigen::Vector2d& pixel) const;
  /// The triangles the view shows.
  ShownSurface surface() const;

  /// Middle of the selected points; nothing when none is.
  std::optional<Eigen::Vector3d> selectionCentre() const;

 private:
  void showProject();
  void showChange(const modeling::Change& change);
  void showMeshBody();
  void showSelection();
  void showMarks();
  void showConditions();

  Editor& editor_;
  ViewportWidget& widget_;
  std::unique_ptr<modeling::Tessellation> tessellation_;
  modeling::Tessellation::Shape shape_;  // of the present control points
  std::optional<int> hovered_;
  std::optional<int> hoveredPatch_;
  view::GizmoAxis axis_ = view::GizmoAxis::kNone;
};

}  // namespace palpa::gui
