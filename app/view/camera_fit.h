#pragma once

#include <vtkRenderer.h>

#include <Eigen/Core>
#include <vector>

#include "app/view/rectangle.h"
#include "app/view/scene.h"
#include "app/view/view_fit.h"

/// Cameras. Internal to app/view.
namespace palpa::view {

/// Places the renderer's active camera so that, at zoom 1, all `points` appear inside `target`, as
/// large as possible and centred. `width` and `height` are the picture's size in pixels.
void fitCamera(const CameraView& view, const std::vector<Eigen::Vector3d>& points,
               const Rectangle& target, int width, int height, vtkRenderer* renderer);

/// Pixel coordinates of a point of the scene.
Eigen::Vector2d toPixels(const Eigen::Vector3d& point, vtkRenderer* renderer);

}  // namespace palpa::view
