#pragma once

#include <vector>

#include "bem/model/boundary_mesh.h"
#include "bem/spline/spline_surface.h"

namespace palpa::bem {

/// A function of a patch: place (i, j) of its net.
struct SplineOccurrence {
  int patch, i, j;
};

/// The places in the nets at which each coefficient stands.
std::vector<std::vector<SplineOccurrence>> occurrences(const SplineSurface& surface);

/// The elements of a patch that contain a point of it: up to four.
std::vector<SplinePlace> placesInPatch(const SplineSurface& surface, int patch, double u, double v);

/// The elements that meet at the Greville point of a function of a patch, with its parameters.
std::vector<SplinePlace> grevillePlaces(const SplineSurface& surface, const SplineOccurrence& at);

/// The coefficients of the traction field: one per (displacement coefficient, smoothing group,
/// tag), as TractionSlots has for nodes. So the traction jumps at sharp edges and where a support
/// begins, which a single-valued one pays for with errors of 18 to 29 %. `slots.ofCorner` is empty.
struct SplineTractions {
  explicit SplineTractions(const SplineSurface& surface);

  TractionSlots slots;
  /// Per element: the slot of each of its functions.
  std::vector<std::vector<int>> ofFunction;
};

}  // namespace palpa::bem
