#pragma once

#include <vector>

#include "bem/model/boundary_mesh.h"
#include "bem/spline/spline_surface.h"

namespace palpa::bem {

/// Occurrence of a function in a patch: position (i, j) in its net.
struct SplineOccurrence {
  int patch, i, j;
};

/// Occurrences of each coefficient in the nets, indexed by coefficient.
std::vector<std::vector<SplineOccurrence>> occurrences(const SplineSurface& surface);

/// Places of a point of a patch in all elements of the patch that contain it: up to four.
std::vector<ElementPlace> placesInPatch(const SplineSurface& surface, int patch, double u,
                                        double v);

/// Places, in the elements that meet there, of the Greville point of a function of a patch.
std::vector<ElementPlace> grevillePlaces(const SplineSurface& surface, const SplineOccurrence& at);

/// Coefficients of the traction field: one per (displacement coefficient, smoothing group, tag), as
/// TractionSlots defines for nodes. The traction therefore jumps at sharp edges and at the border
/// of a support; a single-valued traction has errors of 18 to 29 % there. `slots.ofCorner` is
/// empty.
struct SplineTractions {
  explicit SplineTractions(const SplineSurface& surface);

  TractionSlots slots;
  /// Slots of the functions of each element: [element][function]. For functions that carry no
  /// traction, any slot of their coefficient.
  std::vector<std::vector<int>> ofFunction;
};

}  // namespace palpa::bem
