#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "modeling/mesh/mesh.h"

// From regions to half spaces and triangles. In all of these a set of half spaces is a bit pattern:
// bit k stands for the k-th of distinctHalfSpaces().
namespace palpa::modeling {

/// The distinct half spaces of all regions, in order of appearance.
/// @throws ModelingError when there are more than 64
std::vector<HalfSpace> distinctHalfSpaces(std::span<const MeshRegion> regions);

/// Triangles of a region, ascending. `insideOfTriangle` are the half spaces each triangle lies in.
/// @throws ModelingError that begins with the region's name when there are none
std::vector<int> trianglesOf(const MeshRegion& region, const Solid& solid,
                             const std::vector<int>& patchOfTriangle,
                             const std::vector<std::uint64_t>& insideOfTriangle,
                             const std::vector<HalfSpace>& halfSpaces);

/// Half spaces that belong to a region with refineBorder.
std::uint64_t refinedBorders(std::span<const MeshRegion> regions,
                             const std::vector<HalfSpace>& halfSpaces);

/// Patches named in a region with refineBorder: their outer edges are borders, too.
std::set<int> refinedPatches(std::span<const MeshRegion> regions, const Solid& solid);

}  // namespace palpa::modeling
