#include "modeling/mesh/engine_choice.h"

#include <algorithm>

#include "modeling/solid/surface_evaluator.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::modeling {
namespace {

/// Depth of a region's border inside a patch that does not count, over the size of the body.
constexpr double kTolerance = 1e-3;

bool hasStrokes(const std::vector<RegionPart>& parts) {
  return std::any_of(parts.begin(), parts.end(),
                     [](const RegionPart& part) { return std::holds_alternative<Stroke>(part); });
}

bool hasSpace(const std::vector<RegionPart>& parts) {
  return std::any_of(parts.begin(), parts.end(), [](const RegionPart& part) {
    return !std::holds_alternative<PatchSet>(part);
  });
}

/// True if the border of the region runs through the inside of a patch.
bool cutsPatches(const Region& region, const Solid& solid) {
  if (!hasSpace(region.parts) && !hasSpace(region.except)) return false;
  if (hasStrokes(region.parts) || hasStrokes(region.except)) return true;
  const SurfaceEvaluator surface(solid);
  constexpr int kCells = 12;
  std::vector<Eigen::Vector3d> places;
  std::vector<int> patches;
  for (int patch = 0; patch < surface.patchCount(); ++patch) {
    const auto [uLow, uHigh] = surface.range(patch, 0);
    const auto [vLow, vHigh] = surface.range(patch, 1);
    for (int i = 0; i <= kCells; ++i)
      for (int k = 0; k <= kCells; ++k) {
        places.push_back(surface.position(patch, uLow + (uHigh - uLow) * i / kCells,
                                          vLow + (vHigh - vLow) * k / kCells));
        patches.push_back(patch);
      }
  }
  const auto [low, high] = boundingBox(solid);
  const double tolerance = kTolerance * (high - low).norm();
  const std::vector<double> field = regionField(region, solid, places, patches);
  const std::size_t each = static_cast<std::size_t>(kCells + 1) * (kCells + 1);
  for (std::size_t first = 0; first < field.size(); first += each) {
    const auto [least, most] = std::minmax_element(field.begin() + static_cast<long>(first),
                                                   field.begin() + static_cast<long>(first + each));
    const double deepest = *least, farthest = *most;
    if (deepest < -tolerance && farthest > tolerance) return true;
  }
  return false;
}

}  // namespace

Engine engineFor(const Body& body, Engine wanted, std::span<const MeshRegion> regions) {
  if (wanted != Engine::kAutomatic) return wanted;
  const auto* solid = std::get_if<Solid>(&body);
  if (!solid) return Engine::kQuadratic;
  const bool isCut = std::any_of(regions.begin(), regions.end(), [&](const MeshRegion& region) {
    return region.isSupport && cutsPatches(region.where, *solid);
  });
  return isCut ? Engine::kQuadratic : Engine::kSplines;
}

}  // namespace palpa::modeling
