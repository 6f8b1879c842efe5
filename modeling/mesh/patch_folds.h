#pragma once

#include <vector>

#include "base/job.h"
#include "modeling/solid/edge_curve.h"

namespace palpa::modeling {

/// A place inside a patch where the parametrisation is not that of a surface with one outside.
struct PatchFold {
  SurfaceParameter at;
  bool isFlat = false;  ///< du × dv vanishes around here; otherwise it turns over here
};

/// At most one place per patch, found at sample points inside the polynomial spans (corners and
/// sides, where derivatives may be parallel, are left out). Between neighbouring samples whose
/// normals differ by more than a right angle the place is narrowed down by bisection: only where
/// the normal jumps to its opposite is there a fold, not where it turns quickly.
/// Cost: about a microsecond per sample, 16 per span or 256 per patch. @throws Cancelled
std::vector<PatchFold> patchFolds(const SurfaceEvaluator& surface, const Job& job = {});

}  // namespace palpa::modeling
