#pragma once

#include <array>
#include <optional>
#include <vector>

#include "app/view/camera/turntable.h"
#include "app/view/scene/scene.h"

/// Where the handles of the gizmo lie and which one is under the pointer. Internal to app/view;
/// pure arithmetic, no VTK.
namespace palpa::view {

/// Sizes of the gizmo in logical pixels.
namespace gizmo_size {
inline constexpr double kStart = 14;  ///< of arrows, from the middle
inline constexpr double kEnd = 90;
inline constexpr double kMiddleRadius = 6;
inline constexpr double kMiddleBox = 11;  ///< side
inline constexpr double kRing = 74;       ///< radius
inline constexpr double kOuterRing = 90;
}  // namespace gizmo_size

/// One arrow of the gizmo as it is drawn.
struct GizmoArrow {
  GizmoAxis axis = GizmoAxis::kNone;
  Eigen::Vector3d direction;  ///< unit
  Eigen::Vector3d start;      ///< a little away from the gizmo's place
  Eigen::Vector3d end;
};

/// One ring for turning: the half of it that faces the viewer, or all of it when it lies parallel
/// to the screen.
struct GizmoRing {
  GizmoAxis axis = GizmoAxis::kNone;
  std::vector<std::array<Eigen::Vector3d, 2>> segments;
};

/// Millimetres per logical pixel at the gizmo; nothing if it lies behind the eye.
std::optional<double> gizmoScale(const Gizmo& gizmo, const Turntable& camera, double pixelRatio);

/// The gizmo moved parallel to the screen so that its handles lie in the picture; unchanged if its
/// place is outside of the picture.
Gizmo gizmoInPicture(const Gizmo& gizmo, const Turntable& camera, double pixelRatio);

/// The visible arrows, or shafts with boxes: without arrows that point at the eye, and none if the
/// gizmo lies behind it. Their length is constant in pixels. None for a gizmo that turns.
std::vector<GizmoArrow> gizmoArrows(const Gizmo& gizmo, const Turntable& camera, double pixelRatio);

/// The rings of a gizmo that turns, the outer one (kAll, about the direction of view) first.
std::vector<GizmoRing> gizmoRings(const Gizmo& gizmo, const Turntable& camera, double pixelRatio);

/// The handle nearest to `pixel` within easy reach; the one in front if several are about as
/// near.
GizmoAxis gizmoAxisAt(const Eigen::Vector2d& pixel, const Gizmo& gizmo, const Turntable& camera,
                      double pixelRatio);

}  // namespace palpa::view
