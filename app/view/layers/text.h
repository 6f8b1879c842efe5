#pragma once

#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <Eigen/Core>
#include <string>

#include "app/view/colour_map.h"

/// Flat text in pixel coordinates. Internal to app/view.
namespace palpa::view {

struct TextStyle {
  double size = 15;  ///< font size in pixels
  bool bold = false;
  Colour colour = kTextColour;

  bool operator==(const TextStyle&) const = default;
};

/// Text whose lower left corner is set by `placeText`; VTK's built-in Arial, so that pictures do
/// not depend on the fonts of the machine.
vtkSmartPointer<vtkTextActor> makeText(const std::string& text, const TextStyle& style);

/// Width and height in pixels.
Eigen::Vector2d textSize(vtkTextActor* text, vtkRenderer* renderer);

/// Adds the text with its lower left corner at `corner` (pixels).
void placeText(vtkTextActor* text, const Eigen::Vector2d& corner, vtkRenderer* renderer);

}  // namespace palpa::view
