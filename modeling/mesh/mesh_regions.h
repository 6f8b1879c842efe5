#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "modeling/mesh/mesh_settings.h"
#include "modeling/mesh/region_border.h"

// From regions to borders and triangles. In all of these a set of borders is a bit pattern:
// bit k stands for the k-th of distinctBorders().
namespace palpa::modeling {

/// The distinct borders of all regions (half spaces, and the strokes of each), in order of
/// appearance.
/// @throws ModelingError when there are more than 64
std::vector<RegionBorder> distinctBorders(std::span<const MeshRegion> regions);

/// Triangles of a region, ascending. `insideOfTriangle` are the borders each triangle lies in.
/// @throws ModelingError that begins with the region's name when there are none
std::vector<int> trianglesOf(const MeshRegion& region, const Body& body,
                             const std::vector<int>& patchOfTriangle,
                             const std::vector<std::uint64_t>& insideOfTriangle,
                             const std::vector<RegionBorder>& borders);

/// Borders that belong to a region with refineBorder.
std::uint64_t refinedBorders(std::span<const MeshRegion> regions,
                             const std::vector<RegionBorder>& borders);

/// Patches named in a region with refineBorder: their outer edges are borders, too.
std::set<int> refinedPatches(std::span<const MeshRegion> regions, const Body& body);

}  // namespace palpa::modeling
