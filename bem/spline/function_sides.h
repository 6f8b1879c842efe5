#pragma once

#include <vector>

#include "bem/spline/spline_tractions.h"

namespace palpa::bem {

/// Side of the borders (SplineSurface::side()) to which the function of each coefficient belongs:
/// of its Greville point, or kFixedPatch if it is nonzero on such an element. A side of a patch
/// without a Greville point gets the function with the largest part there. `places`:
/// occurrences(surface).
std::vector<int> sidesOfFunctions(const SplineSurface& surface,
                                  const std::vector<std::vector<SplineOccurrence>>& places);

/// True if functions that belong to one side are used on elements of the other as they are.
inline bool isUsable(int sideOfFunction, int side) {
  return sideOfFunction == side || sideOfFunction == SplineSurface::kFixedPatch;
}

}  // namespace palpa::bem
