#include "modeling/mesh/half_spaces.h"

#include <algorithm>

#include "modeling/error.h"

namespace palpa::modeling {
namespace {

std::uint64_t bitOf(const HalfSpace& half, const std::vector<HalfSpace>& halfSpaces) {
  return std::uint64_t{1} << (std::find(halfSpaces.begin(), halfSpaces.end(), half) -
                              halfSpaces.begin());
}

}  // namespace

std::vector<HalfSpace> distinctHalfSpaces(std::span<const MeshRegion> regions) {
  constexpr std::size_t kMost = 64;
  std::vector<HalfSpace> result;
  for (const MeshRegion& region : regions)
    for (const RegionPart& part : region.where.parts) {
      const auto* half = std::get_if<HalfSpace>(&part);
      if (half && std::find(result.begin(), result.end(), *half) == result.end())
        result.push_back(*half);
    }
  if (result.size() > kMost)
    throw ModelingError("the regions have " + std::to_string(result.size()) +
                            " different half spaces; at most 64 are possible",
                        ModelingError::Kind::tooLarge);
  return result;
}

std::uint64_t refinedBorders(std::span<const MeshRegion> regions,
                             const std::vector<HalfSpace>& halfSpaces) {
  std::uint64_t bits = 0;
  for (const MeshRegion& region : regions)
    for (const RegionPart& part : region.where.parts)
      if (const auto* half = std::get_if<HalfSpace>(&part); half && region.refineBorder)
        bits |= bitOf(*half, halfSpaces);
  return bits;
}

bool isInside(std::uint64_t sides, const HalfSpace& half,
              const std::vector<HalfSpace>& halfSpaces) {
  return (sides & bitOf(half, halfSpaces)) != 0;
}

void failEmptyRegion(const MeshRegion& region) {
  throw ModelingError(region.name +
                      ": no part of the surface lies in this region; check the half space "
                      "(normal · x < below_mm) against the size and place of the solid");
}

}  // namespace palpa::modeling
