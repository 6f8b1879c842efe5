#pragma once

#include <array>
#include <vector>

#include "modeling/solid/surface_evaluator.h"

namespace palpa::modeling {

/// Into how many pieces each patch is divided, per direction; as double because estimates must
/// survive absurdly small edge lengths. Glued sides have equal counts by construction.
using Counts = std::vector<std::array<double, 2>>;

/// A count belongs to a chain: all patch directions connected over glued edges. It is the largest
/// mean arc length in the chain (Simpson's rule over the two sides and the middle line) divided by
/// the edge length, rounded, at least 1.
Counts subdivisionCounts(const Solid& solid, const SurfaceEvaluator& surface, double edgeLength);

/// Nodes of the structured mesh with these counts, exact.
double structuredNodeCount(const Solid& solid, const Counts& counts);

}  // namespace palpa::modeling
