#pragma once

#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <Eigen/Core>
#include <string>

#include "app/view/scene/theme.h"

/// Flat text in pixel coordinates. Internal to app/view.
namespace palpa::view {

struct TextStyle {
  double size = 15;  ///< font size in pixels
  bool bold = false;
  Colour colour{0.10, 0.11, 0.13};

  bool operator==(const TextStyle&) const = default;
};

/// Text placed by its lower left corner, in VTK's built-in Arial, so that pictures do not depend on
/// the fonts of the machine.
vtkSmartPointer<vtkTextActor> makeText(const std::string& text, const TextStyle& style);

/// Width and height in pixels.
Eigen::Vector2d textSize(vtkTextActor* text, vtkRenderer* renderer);

}  // namespace palpa::view
