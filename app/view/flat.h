#pragma once

#include <vtkRenderer.h>

#include <Eigen/Core>
#include <vector>

#include "app/view/colour_map.h"
#include "app/view/rectangle.h"

/// Flat shapes in pixel coordinates. Internal to app/view.
namespace palpa::view {

/// A polyline of the given width in pixels.
void addFlatLine(const std::vector<Eigen::Vector2d>& points, const Colour& colour, double width,
                 vtkRenderer* overlay);

/// A filled convex polygon.
void addFlatPolygon(const std::vector<Eigen::Vector2d>& points, const Colour& colour,
                    vtkRenderer* overlay);

/// A filled rectangle.
void addFlatRectangle(const Rectangle& rectangle, const Colour& colour, vtkRenderer* overlay,
                      double opacity = 1);

}  // namespace palpa::view
