#pragma once

#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <vector>

#include "app/view/colour_map.h"
#include "app/view/label_placement.h"
#include "app/view/scene.h"
#include "app/view/viewport_scene.h"

/// Force arrows. Internal to app/view.
namespace palpa::view {

/// Thickness relative to the body's diagonal, the same for all arrows: only the length speaks.
inline constexpr double kArrowShaftRadius = 0.0075;
inline constexpr double kArrowHeadRadius = 0.021;
inline constexpr double kArrowHeadLength = 0.062;

/// Where an arrow is drawn.
struct PlacedArrow {
  Eigen::Vector3d tail;
  Eigen::Vector3d tip;
  const ForceArrow* arrow = nullptr;

  /// The end away from `arrow->at`, where the label goes.
  const Eigen::Vector3d& freeEnd() const;
  const Eigen::Vector3d& heldEnd() const;
};

/// Ends of all arrows with a force, the largest `longest` (mm) long.
std::vector<PlacedArrow> placeArrows(const std::vector<ForceArrow>& arrows, double longest);

/// Ends of all arrows with a force, `longest` (mm) long for `fullForce` (N) and more, in proportion
/// below.
std::vector<PlacedArrow> placeLiveArrows(const LiveArrows& arrows, double longest);

/// How light falls on arrows, in pictures and in the window.
void setArrowLooks(vtkProperty* property, double opacity);

/// In the colours of pictures.
const Colour& arrowColour(ForceArrow::Role role);

/// Adds the arrows as solid bodies to `renderer`. Called once for the scene's own renderer and once
/// for a translucent one in front, so that an arrow inside or behind the body still shines through.
void addArrows(const std::vector<PlacedArrow>& arrows, double bodyDiagonal, double opacity,
               vtkRenderer* renderer);

/// Writes the labels in `overlay` beside the free ends, within `bounds`, where `occupancy` (which
/// they join) leaves room. `scene` is the renderer whose camera shows the arrows.
void addArrowLabels(const std::vector<PlacedArrow>& arrows, double fontSize,
                    const Rectangle& bounds, Occupancy& occupancy, vtkRenderer* scene,
                    vtkRenderer* overlay);

}  // namespace palpa::view
