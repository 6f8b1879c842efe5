#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "modeling/mesh/mesh.h"

namespace palpa::modeling {

/// The distinct half spaces of all regions; their order gives the bits of a triangle's sides.
/// @throws ModelingError when there are more than 64
std::vector<HalfSpace> distinctHalfSpaces(std::span<const MeshRegion> regions);

/// Bits of the half spaces that belong to a region with refineBorder.
std::uint64_t refinedBorders(std::span<const MeshRegion> regions,
                             const std::vector<HalfSpace>& halfSpaces);

/// Is a triangle with these sides inside the half space, which is one of `halfSpaces`?
bool isInside(std::uint64_t sides, const HalfSpace& half, const std::vector<HalfSpace>& halfSpaces);

/// What mesh() says about a region without a triangle.
[[noreturn]] void failEmptyRegion(const MeshRegion& region);

}  // namespace palpa::modeling
