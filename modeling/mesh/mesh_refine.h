#pragma once

#include <functional>
#include <set>

#include "modeling/mesh/mesh_editor.h"

namespace palpa::modeling {

/// Growth of the triangle size per distance from the place of the smallest size.
inline constexpr double kSizeGrowth = 0.5;

/// boundAspect() cuts triangles of narrow patches across until their aspect (as
/// MeshQuality::largestAspect) is at most kMaxAspect or their edges have kMaxCuts pieces.
inline constexpr double kMaxAspect = 4.5;
inline constexpr int kMaxCuts = 16;
/// Beside such patches: longest over shortest edge of a triangle.
inline constexpr double kMaxUnevenness = 3;

/// Bisects a triangle at its longest edge. While the neighbour across this edge has a longer edge,
/// the neighbour is bisected first, so that angles stay bounded from below (Rivara's longest-edge
/// bisection).
void bisect(MeshEditor& editor, int triangle);

/// Bisects triangles until none is larger than the wanted size at its place. This size is
/// `smallest` (mm) on the edges for which isSource(a, b) holds and grows by kSizeGrowth per
/// distance up to `largest` (mm). Distances are measured along mesh edges.
void refineTowards(MeshEditor& editor, const std::function<bool(int, int)>& isSource,
                   double smallest, double largest);

/// Halves the long edges of the triangles in the given patches, whose cells are long and narrow,
/// until they are within kMaxAspect or kMaxCuts, and grades the surrounding patches, so that the
/// longest edge of a triangle is at most kMaxUnevenness of its shortest one. `longPatches`:
/// others, whose cells are longer than that by themselves, which are halved once. The mesh must be
/// as structuredMesh() made it.
void boundAspect(MeshEditor& editor, const std::set<int>& narrowPatches,
                 const std::set<int>& longPatches);

}  // namespace palpa::modeling
