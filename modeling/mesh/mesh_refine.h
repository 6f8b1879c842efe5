#pragma once

#include <functional>
#include <set>

#include "modeling/mesh/mesh_editor.h"

namespace palpa::modeling {

/// Growth of the triangle size per distance from where it is smallest.
inline constexpr double kSizeGrowth = 0.5;

/// Triangles of narrow patches are cut across until their aspect (MeshQuality::largestAspect) is at
/// most this, but each edge into at most kMaxCuts pieces.
inline constexpr double kMaxAspect = 4.5;
inline constexpr int kMaxCuts = 16;

/// Cuts the triangle's longest edge; first that of its neighbour across it while longer, so that
/// angles stay bounded from below (Rivara's longest-edge bisection).
void bisect(MeshEditor& editor, int triangle);

/// Bisects until triangles are not larger than the size wanted at their place: `smallest` mm on the
/// edges for which isSource(a, b) holds, growing by kSizeGrowth per distance up to `largest`.
/// Distances are measured along mesh edges.
void refineTowards(MeshEditor& editor, const std::function<bool(int, int)>& isSource,
                   double smallest, double largest);

/// Halves the long edges of the triangles in the named patches, whose cells are long and narrow,
/// until they are within the bounds above, and grades the patches around them. For a structured
/// mesh.
void boundAspect(MeshEditor& editor, const std::set<int>& narrowPatches);

}  // namespace palpa::modeling
