#pragma once

#include <vtkRenderer.h>

#include <optional>
#include <vector>

#include "app/view/turntable.h"
#include "app/view/viewport_geometry.h"
#include "app/view/viewport_scene.h"

/// The arrows for moving a selection. Internal to app/view.
namespace palpa::view {

/// One arrow of the gizmo as it is drawn.
struct GizmoArrow {
  GizmoAxis axis = GizmoAxis::kNone;
  Eigen::Vector3d direction;  ///< unit
  Eigen::Vector3d start;      ///< a little away from the gizmo's place
  Eigen::Vector3d end;
};

/// The arrows that can be seen from the camera: not those that point at the eye, and none when the
/// gizmo lies behind it. Their length is constant in pixels.
std::vector<GizmoArrow> gizmoArrows(const Gizmo& gizmo, const Turntable& camera, double pixelRatio);

/// The arrow nearest to `pixel` within easy reach.
GizmoAxis gizmoAxisAt(const Eigen::Vector2d& pixel, const Gizmo& gizmo, const Turntable& camera,
                      double pixelRatio);

class GizmoActor {
 public:
  explicit GizmoActor(vtkRenderer* renderer);

  /// To be called before drawing.
  void update(const std::optional<Gizmo>& gizmo, const Turntable& camera, double pixelRatio);

 private:
  std::array<vtkSmartPointer<vtkActor>, 4> arrows_;
  vtkSmartPointer<vtkActor> middle_;
};

}  // namespace palpa::view
