#pragma once

#include <array>
#include <set>
#include <vector>

#include "base/job.h"
#include "modeling/mesh/mesh_settings.h"
#include "modeling/solid/surface_evaluator.h"

namespace palpa::modeling {

/// Into how many pieces each patch is divided, per direction; as double because estimates must
/// survive absurdly small edge lengths. Glued sides have equal counts by construction.
using Counts = std::vector<std::array<double, 2>>;

/// The edge length wanted on each patch: the settings' times the patch's factor.
std::vector<double> patchEdgeLengths(const Solid& solid, const MeshSettings& settings);

/// A count belongs to a chain: all patch directions connected over glued edges. It is the largest
/// mean number of pieces in the chain (IsoCurve::pieces, Simpson's rule over the two sides and the
/// middle line), rounded, at least 1. @throws Cancelled
Counts subdivisionCounts(const Solid& solid, const SurfaceEvaluator& surface,
                         const std::vector<double>& edgeLengths, const Job& job = {});

/// Nodes of the structured mesh with these counts, exact.
double structuredNodeCount(const Solid& solid, const Counts& counts);

/// Patches with cells so long and narrow that boundAspect() has to cut them.
std::set<int> narrowPatches(const SurfaceEvaluator& surface, const Counts& counts);

/// Nodes that boundAspect() adds, roughly.
double narrowPatchNodes(const SurfaceEvaluator& surface, const Counts& counts);

}  // namespace palpa::modeling
