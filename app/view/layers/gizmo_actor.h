#pragma once

#include <vtkRenderer.h>

#include <array>
#include <optional>

#include "app/view/camera/turntable.h"
#include "app/view/layers/flat_shapes.h"
#include "app/view/layers/gizmo_handles.h"
#include "app/view/layers/vtk_arrays.h"
#include "app/view/scene/scene.h"

/// The handles for moving, turning and scaling a selection. Internal to app/view.
namespace palpa::view {

/// Arrows and boxes in a renderer in front of the scene; rings as flat shapes.
class GizmoActor {
 public:
  explicit GizmoActor(vtkRenderer* renderer);

  /// To be called before drawing, between clear() and finish() of `shapes`.
  void update(const std::optional<Gizmo>& gizmo, const Turntable& camera, double pixelRatio,
              FlatShapes& shapes);

 private:
  using Handles = std::array<vtkSmartPointer<vtkActor>, 5>;  // x, y, z, normal, gradient

  Handles arrows_, boxes_;
  vtkSmartPointer<vtkActor> middle_, middleBox_;
};

}  // namespace palpa::view
