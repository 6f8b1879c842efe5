#pragma once

#include <array>
#include <span>
#include <vector>

#include "bem/spline/surface_part.h"
#include "modeling/body/region.h"
#include "modeling/solid/solid.h"
#include "modeling/solid/surface_evaluator.h"

// Where regions of a solid's surface are, for the spline discretisation.
namespace palpa::app {

/// A region in the terms of the boundary elements: named patches whole, half spaces and strokes by
/// their distance (mm).
bem::SurfacePart surfacePart(const modeling::Region& region, const modeling::Solid& solid);

/// Where supports end: there tractions are singular.
struct SupportBorders {
  /// Per edge of the solid: a support ends along it.
  std::vector<bool> edges;
  /// A place where a border runs through a patch.
  struct Place {
    int patch;
    std::array<double, 2> parameters;
    /// How much the border's normal lies along u and v: absolute cosines.
    std::array<double, 2> along;
    double radius;  ///< of the strokes that bound the region there, mm; infinite for half spaces
  };
  std::vector<Place> places;
};

/// By sampling: borders are seen where they are longer than a 24th of a patch or the radius of
/// their strokes. About 0.6 ms per patch that a border may cross.
SupportBorders supportBorders(const modeling::Solid& solid,
                              const modeling::SurfaceEvaluator& surface,
                              std::span<const modeling::Region> supports);

}  // namespace palpa::app
