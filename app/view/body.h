#pragma once

#include <vtkRenderer.h>

#include "app/view/scene.h"

/// The solid itself. Internal to app/view.
namespace palpa::view {

/// Adds the surface (with its field, supports, edges and contact patches), and the ghost of its
/// undeformed shape when asked for. Silhouettes follow the renderer's active camera.
/// `pixel` is the width of a hairline in pixels.
void addBody(const SurfaceScene& scene, vtkRenderer* renderer, double pixel);

/// A key light from the upper left of the camera and a soft fill from the right.
void addLights(vtkRenderer* renderer);

}  // namespace palpa::view
