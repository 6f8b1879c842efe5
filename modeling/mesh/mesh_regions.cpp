#include "modeling/mesh/mesh_regions.h"

#include <algorithm>

#include "modeling/error.h"

namespace palpa::modeling {
namespace {

std::size_t indexOf(const HalfSpace& half, const std::vector<HalfSpace>& halfSpaces) {
  return std::find(halfSpaces.begin(), halfSpaces.end(), half) - halfSpaces.begin();
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

std::vector<int> trianglesOf(const MeshRegion& region, const Body& body,
                             const std::vector<int>& patchOfTriangle,
                             const std::vector<std::uint64_t>& insideOfTriangle,
                             const std::vector<HalfSpace>& halfSpaces) {
  std::uint64_t chosen = 0;
  std::vector<bool> isNamed(patchNames(body).size(), false);
  for (const RegionPart& part : region.where.parts)
    if (const auto* half = std::get_if<HalfSpace>(&part))
      chosen |= std::uint64_t{1} << indexOf(*half, halfSpaces);
    else if (const auto* set = std::get_if<PatchSet>(&part))
      for (const std::string& name : set->patches)
        if (const auto patch = findPatch(body, name)) isNamed[*patch] = true;
  std::vector<int> triangles;
  for (std::size_t t = 0; t < patchOfTriangle.size(); ++t)
    if (isNamed[patchOfTriangle[t]] || (insideOfTriangle[t] & chosen) != 0)
      triangles.push_back(static_cast<int>(t));
  if (triangles.empty())
    throw ModelingError(region.name +
                        ": no part of the surface lies in this region, or one too narrow for the "
                        "edge length; check the half space (normal · x < below_mm) against the "
                        "size and place of the solid");
  return triangles;
}

std::uint64_t refinedBorders(std::span<const MeshRegion> regions,
                             const std::vector<HalfSpace>& halfSpaces) {
  std::uint64_t bits = 0;
  for (const MeshRegion& region : regions)
    for (const RegionPart& part : region.where.parts)
      if (const auto* half = std::get_if<HalfSpace>(&part); half && region.refineBorder)
        bits |= std::uint64_t{1} << indexOf(*half, halfSpaces);
  return bits;
}

std::set<int> refinedPatches(std::span<const MeshRegion> regions, const Body& body) {
  std::set<int> patches;
  for (const MeshRegion& region : regions)
    for (const RegionPart& part : region.where.parts)
      if (const auto* set = std::get_if<PatchSet>(&part); set && region.refineBorder)
        for (const std::string& name : set->patches) patches.insert(*findPatch(body, name));
  return patches;
}

}  // namespace palpa::modeling
