#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "modeling/mesh/mesh_settings.h"
#include "modeling/mesh/region_border.h"

// Borders and triangles of regions. A set of borders is a bit pattern: bit k stands for element k
// of distinctBorders().
namespace palpa::modeling {

/// The distinct borders of all regions (half spaces, and the strokes of each region), in order of
/// appearance. Throws ModelingError if there are more than 64.
std::vector<RegionBorder> distinctBorders(std::span<const MeshRegion> regions);

/// Triangles of a region, ascending. `insideOfTriangle` holds the set of borders around each
/// triangle. Throws ModelingError that begins with the region's name if there are none.
std::vector<int> trianglesOf(const MeshRegion& region, const Body& body,
                             const std::vector<int>& patchOfTriangle,
                             const std::vector<std::uint64_t>& insideOfTriangle,
                             const std::vector<RegionBorder>& borders);

/// Set of the borders that belong to a region with isSupport.
std::uint64_t refinedBorders(std::span<const MeshRegion> regions,
                             const std::vector<RegionBorder>& borders);

/// Patches named in a region with isSupport. Their outer edges are borders, too.
std::set<int> refinedPatches(std::span<const MeshRegion> regions, const Body& body);

}  // namespace palpa::modeling
