#pragma once

#include <Eigen/Core>
#include <numbers>
#include <vector>

#include "app/view/scene/scene.h"

/// Finding the camera that shows given points. Internal to app/view; pure arithmetic, no VTK.
namespace palpa::view {

/// A rectangle of the picture, in pixels from its lower left corner.
struct Rectangle {
  double left = 0;
  double bottom = 0;
  double right = 0;
  double top = 0;

  double width() const { return right - left; }
  double height() const { return top - bottom; }
};

/// Of every perspective camera, rad.
inline constexpr double kVerticalViewAngle = 24 * std::numbers::pi / 180;

/// Orthonormal axes of a view: to the right, up, and from the eye into the scene.
struct ViewAxes {
  Eigen::Vector3d right;
  Eigen::Vector3d up;
  Eigen::Vector3d forward;

  /// Takes points of the scene to (right, up, forward).
  Eigen::Matrix3d toView() const;
};
ViewAxes viewAxes(const CameraView& view);

/// Where a camera looks and how large things appear there.
struct Placement {
  Eigen::Vector3d focus;       ///< in view coordinates
  double pixelsPerLength = 1;  ///< in the plane through the focus
};

/// The placement for which all `points` (at least one) appear inside `target`, as large as possible
/// and centred. `height`: of the picture, in pixels.
Placement fitPlacement(bool parallel, const std::vector<Eigen::Vector3d>& points,
                       const Eigen::Matrix3d& toView, const Rectangle& target, int height);

}  // namespace palpa::view
