#pragma once

#include <array>
#include <set>
#include <vector>

#include "base/job.h"
#include "modeling/mesh/mesh_settings.h"
#include "modeling/solid/surface_evaluator.h"

namespace palpa::modeling {

/// Number of pieces of each patch per direction. The type is double because estimates must not
/// overflow for absurdly small edge lengths. Glued sides have equal counts by construction.
using Counts = std::vector<std::array<double, 2>>;

/// Wanted edge length on each patch (mm): settings.edgeLength times the factor of the patch.
std::vector<double> patchEdgeLengths(const Solid& solid, const MeshSettings& settings);

/// Counts of the structured mesh. Each count belongs to a chain: all patch directions connected
/// over glued edges. It is the largest mean number of pieces in the chain (IsoCurve::pieces,
/// Simpson's rule over the two sides and the middle line), rounded, at least 1. Throws Cancelled.
Counts subdivisionCounts(const Solid& solid, const SurfaceEvaluator& surface,
                         const std::vector<double>& edgeLengths, const Job& job = {});

/// Exact number of nodes of the structured mesh with these counts.
double structuredNodeCount(const Solid& solid, const Counts& counts);

/// Patches with cells so long and narrow that boundAspect() must cut them.
std::set<int> narrowPatches(const SurfaceEvaluator& surface, const Counts& counts);
/// Other patches whose cells are longer than kMaxUnevenness by themselves.
std::set<int> longPatches(const SurfaceEvaluator& surface, const Counts& counts);

/// Rough estimate of the number of nodes that boundAspect() adds.
double narrowPatchNodes(const SurfaceEvaluator& surface, const Counts& counts);

}  // namespace palpa::modeling
