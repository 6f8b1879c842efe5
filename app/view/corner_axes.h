#pragma once

#include <vtkRenderer.h>

#include "app/view/camera_fit.h"

namespace palpa::view {

/// Draws the directions x, y, z in red, green and blue, as seen by `view`, in the square `place`
/// (pixels). Internal to app/view.
void addCornerAxes(const CameraView& view, const Rectangle& place, double fontSize, double pixel,
                   vtkRenderer* overlay);

}  // namespace palpa::view
