#pragma once

#include <QObject>
#include <memory>
#include <optional>

#include "app/gui/editor.h"
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

  /// Points that show all that is selected in the view.
  std::vector<Eigen::Vector3d> selectedPlaces() const;
  /// Middle of the selected points; nothing when none is.
  std::optional<Eigen::Vector3d> selectionCentre() const;

 private:
  void showProject();
  void showChange(const modeling::Change& change);
  void showMeshBody();
  void showSelection();
  void showRegions();
  void showMarks();
  void setPatches(const std::vector<view::Triangle>& triangles,
                  const std::vector<int>& patchOfTriangle);

  Editor& editor_;
  ViewportWidget& widget_;
  std::unique_ptr<modeling::Tessellation> tessellation_;
  modeling::Tessellation::Shape shape_;  // as shown
  std::vector<int> patchOfTriangle_, patchOfPosition_;
  std::optional<int> hovered_;
  view::GizmoAxis axis_ = view::GizmoAxis::kNone;
};

}  // namespace palpa::gui
