#pragma once

#include <optional>

#include "app/gui/document/editor.h"
#include "app/gui/view/surface_place.h"
#include "app/gui/base/units.h"
#include "app/view/viewport_scene.h"

// What the view shows of loads and recorded touches.
namespace palpa::gui {

/// A place well inside a region: the middle of the triangle of the region nearest to the region's
/// centre of area, with the normal there. Nothing when the region has no triangle.
std::optional<SurfacePlace> regionMiddle(const modeling::Region& region, const modeling::Body& body,
                                         const ShownSurface& surface);

/// One arrow for each load, with its name and strength: pressures and bumps press on the surface,
/// tractions pull at it. Directions are meaningful, lengths are not: all have the same.
std::vector<view::ForceArrow> loadArrows(const modeling::Project& project,
                                         const ShownSurface& surface, const ShownUnits& units);

std::vector<view::TouchMarker> touchMarkers(const modeling::Project& project,
                                            const Selection& selection);

}  // namespace palpa::gui
