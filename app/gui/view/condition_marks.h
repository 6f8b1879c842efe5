#pragma once

#include <optional>

#include "app/gui/base/units.h"
#include "app/gui/document/editor.h"
#include "app/gui/view/surface_place.h"
#include "app/view/scene/scene.h"

// Marks of loads and stored touches in the view.
namespace palpa::gui {

/// Place inside a region: the centre of the triangle nearest to the region's centre of area, with
/// its normal. Nothing if the region has no triangle.
std::optional<SurfacePlace> regionMiddle(const modeling::Region& region, const modeling::Body& body,
                                         const ShownSurface& surface);

/// Area of a region, mm²; of whole triangles.
double regionArea(const modeling::Region& region, const modeling::Body& body,
                  const ShownSurface& surface);

/// One arrow for each load, with name and strength. Arrows of pressures and bumps end on the
/// surface, arrows of tractions may begin there, and the weight at the centre of volume. All forces
/// have the same length.
std::vector<view::ForceArrow> loadArrows(const modeling::Project& project,
                                         const ShownSurface& surface, const ShownUnits& units);

std::vector<view::TouchMarker> touchMarkers(const modeling::Project& project,
                                            const Selection& selection);

}  // namespace palpa::gui
