#pragma once

#include <vtkRenderer.h>

#include "app/view/scene.h"

/// The solid itself. Internal to app/view.
namespace palpa::view {

/// Adds the surface with its field, supports, edges and contact patches, and the outline of the
/// undeformed shape when the scene shows it. Silhouettes follow the renderer's active camera.
/// `pixel` is the width of a hairline in pixels.
void addBody(const SurfaceScene& scene, vtkRenderer* renderer, double pixel);

/// Adds the undeformed shape as a translucent surface, to a renderer that is drawn before and
/// covered by that of the body: the two shapes nearly coincide in places, and a border there
/// between "in front" and "behind" would only show rounding errors.
void addGhost(const SurfaceScene& scene, vtkRenderer* background);

/// A key light from the upper left of the camera and a soft fill from the right.
void addLights(vtkRenderer* renderer);

}  // namespace palpa::view
