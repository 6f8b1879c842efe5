#pragma once

#include <array>
#include <span>
#include <vector>

#include "bem/spline/surface_part.h"
#include "modeling/body/region.h"
#include "modeling/project/project.h"
#include "modeling/solid/solid.h"
#include "modeling/solid/surface_evaluator.h"

// Regions of a solid's surface, for the spline discretisation.
namespace palpa::app {

/// A region as a part of the boundary elements' surface: named patches as a whole, half spaces and
/// strokes by their distance (mm).
bem::SurfacePart surfacePart(const modeling::Region& region, const modeling::Solid& solid);

/// True if the spline functions beside the borders of all supports that cut patches have roots
/// (bem::Tearing::kRoots): these are fixed half spaces whose border crosses no sharp edge of the
/// solid, and beside it the surface is nowhere nearly parallel to the plane. Levels of strokes,
/// unions and exceptions have kinks, under rollers tractions may be regular up to the border, and
/// across sharp edges and on shallow slopes some bodies became nearly singular.
bool haveRoots(std::span<const modeling::Support> supports, const modeling::Solid& solid,
               const modeling::SurfaceEvaluator& surface);

/// Borders of supports; tractions are singular there.
struct SupportBorders {
  /// Per edge of the solid: true if a support ends along it.
  std::vector<bool> edges;
  /// A place where a border runs through a patch.
  struct Place {
    int patch;
    std::array<double, 2> parameters;
    /// Absolute cosines between the border's normal and the directions u and v.
    std::array<double, 2> along;
    double radius;  ///< of the strokes that bound the region there, mm; infinite for half spaces
  };
  std::vector<Place> places;
};

/// Finds the borders by sampling: a border is seen if it is longer than a 24th of a patch or the
/// radius of its strokes. About 0.6 ms per patch that a border may cross.
SupportBorders supportBorders(const modeling::Solid& solid,
                              const modeling::SurfaceEvaluator& surface,
                              std::span<const modeling::Region> supports);

}  // namespace palpa::app
