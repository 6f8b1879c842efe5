#include "modeling/mesh/mesh_regions.h"

#include <algorithm>

#include "modeling/error.h"

namespace palpa::modeling {
namespace {

/// Borders of parts: one per half space, and one for all strokes together.
std::vector<RegionBorder> bordersOf(const std::vector<RegionPart>& parts) {
  std::vector<RegionBorder> result;
  std::vector<Stroke> strokes;
  for (const RegionPart& part : parts) {
    if (const auto* half = std::get_if<HalfSpace>(&part)) result.emplace_back(*half);
    if (const auto* stroke = std::get_if<Stroke>(&part)) strokes.push_back(*stroke);
  }
  if (!strokes.empty()) result.emplace_back(std::move(strokes));
  return result;
}

/// The bits of the borders of parts.
std::uint64_t bitsOf(const std::vector<RegionPart>& parts,
                     const std::vector<RegionBorder>& borders) {
  std::uint64_t bits = 0;
  for (const RegionBorder& border : bordersOf(parts))
    bits |=
        std::uint64_t{1} << (std::find(borders.begin(), borders.end(), border) - borders.begin());
  return bits;
}

}  // namespace

std::vector<RegionBorder> distinctBorders(std::span<const MeshRegion> regions) {
  constexpr std::size_t kMaxBorders = 64;
  std::vector<RegionBorder> result;
  for (const MeshRegion& region : regions)
    for (const auto* parts : {&region.where.parts, &region.where.except})
      for (RegionBorder& border : bordersOf(*parts))
        if (std::find(result.begin(), result.end(), border) == result.end())
          result.push_back(std::move(border));
  if (result.size() > kMaxBorders)
    throw ModelingError(
        "the regions have " + std::to_string(result.size()) +
            " different half spaces and paintings; at most 64 are possible: combine some",
        ModelingError::Kind::kTooLarge);
  return result;
}

std::vector<int> trianglesOf(const MeshRegion& region, const Body& body,
                             const std::vector<int>& patchOfTriangle,
                             const std::vector<std::uint64_t>& insideOfTriangle,
                             const std::vector<RegionBorder>& borders) {
  const auto isIn = [&](const std::vector<RegionPart>& parts) {
    return [&, bits = bitsOf(parts, borders), isNamed = namedPatches(parts, body)](std::size_t t) {
      return isNamed[patchOfTriangle[t]] || (insideOfTriangle[t] & bits) != 0;
    };
  };
  const auto isInside = isIn(region.where.parts), isExcepted = isIn(region.where.except);
  std::vector<int> triangles;
  for (std::size_t t = 0; t < patchOfTriangle.size(); ++t)
    if (isInside(t) && !isExcepted(t)) triangles.push_back(static_cast<int>(t));
  if (triangles.empty())
    throw EmptyRegionError(
        region.name, region.name +
                         ": the region contains no part of the surface, or only a part too narrow "
                         "for the edge length; compare the half space (normal · x < below_mm) or "
                         "the stroke (points_mm, radius_mm) with the size and place of the solid");
  return triangles;
}

std::uint64_t refinedBorders(std::span<const MeshRegion> regions,
                             const std::vector<RegionBorder>& borders) {
  std::uint64_t bits = 0;
  for (const MeshRegion& region : regions)
    if (region.isSupport)
      bits |= bitsOf(region.where.parts, borders) | bitsOf(region.where.except, borders);
  return bits;
}

std::set<int> refinedPatches(std::span<const MeshRegion> regions, const Body& body) {
  std::set<int> patches;
  for (const MeshRegion& region : regions)
    for (const RegionPart& part : region.where.parts)
      if (const auto* set = std::get_if<PatchSet>(&part); set && region.isSupport)
        for (const std::string& name : set->patches) patches.insert(*findPatch(body, name));
  return patches;
}

}  // namespace palpa::modeling
