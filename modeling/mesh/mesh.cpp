#include "modeling/mesh/mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>

#include "modeling/error.h"
#include "modeling/mesh/border_fit.h"
#include "modeling/mesh/mesh_counts.h"
#include "modeling/mesh/mesh_improve.h"
#include "modeling/mesh/mesh_refine.h"
#include "modeling/mesh/refinement_estimate.h"
#include "modeling/mesh/structured_mesh.h"
#include "modeling/mesh/work_mesh.h"
#include "modeling/solid/surface_properties.h"
#include "modeling/text.h"

namespace palpa::modeling {
namespace {

constexpr int kMostLevels = 6;
constexpr double kSmallestFactor = 0.05;
constexpr double kLargestFactor = 20.0;

/// Position along the Hilbert curve through a 2^order square grid (standard quadrant recursion).
std::uint64_t hilbertIndex(std::uint32_t x, std::uint32_t y, int order) {
  std::uint64_t index = 0;
  for (std::uint32_t s = 1U << (order - 1); s > 0; s /= 2) {
    const std::uint32_t right = (x & s) ? 1 : 0;
    const std::uint32_t upper = (y & s) ? 1 : 0;
    index += static_cast<std::uint64_t>(s) * s * ((3 * right) ^ upper);
    if (upper == 0) {
      if (right == 1) {
        x = (s - 1) - (x & (s - 1));
        y = (s - 1) - (y & (s - 1));
      }
      std::swap(x, y);
    }
  }
  return index;
}

/// New order of the nodes: by first patch, then along a Hilbert curve in its parameters.
std::vector<int> nodeOrder(const WorkMesh& work, const Counts& counts) {
  constexpr int kOrder = 16;
  std::vector<std::pair<int, std::uint64_t>> key(work.nodes.size());
  for (std::size_t i = 0; i < work.nodes.size(); ++i) {
    const SurfaceParameter& at = work.nodes[i].at.front();
    const auto [uLow, uHigh] = work.surface->range(at.patch, 0);
    const auto [vLow, vHigh] = work.surface->range(at.patch, 1);
    // Equal steps along both directions are equal lengths, so that the curve's tiles are compact.
    const auto& [m, n] = counts[at.patch];
    const double scale = ((1 << kOrder) - 1) / std::max(m, n);
    key[i] = {at.patch,
              hilbertIndex(static_cast<std::uint32_t>((at.u - uLow) / (uHigh - uLow) * m * scale),
                           static_cast<std::uint32_t>((at.v - vLow) / (vHigh - vLow) * n * scale),
                           kOrder)};
  }
  std::vector<int> order(work.nodes.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return key[a] < key[b]; });
  return order;
}

/// Puts nodes and triangles of the work mesh into their final order.
void renumber(WorkMesh& work, const Counts& counts) {
  const std::vector<int> order = nodeOrder(work, counts);
  std::vector<int> number(order.size());
  std::vector<WorkNode> nodes;
  nodes.reserve(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    number[order[i]] = static_cast<int>(i);
    nodes.push_back(std::move(work.nodes[order[i]]));
  }
  work.nodes = std::move(nodes);
  for (WorkTriangle& triangle : work.triangles) {
    auto& [a, b, c] = triangle.nodes;
    triangle.nodes = {number[a], number[b], number[c]};
    std::rotate(triangle.nodes.begin(),
                std::min_element(triangle.nodes.begin(), triangle.nodes.end()),
                triangle.nodes.end());
  }
  std::sort(work.triangles.begin(), work.triangles.end(),
            [](const WorkTriangle& a, const WorkTriangle& b) {
              return std::pair(a.patch, a.nodes) < std::pair(b.patch, b.nodes);
            });
}

/// The distinct half spaces of all regions; their order gives the bits of WorkTriangle::sides.
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

bool contains(const RegionPart& part, const WorkMesh& work, const WorkTriangle& triangle,
              const std::vector<HalfSpace>& halfSpaces) {
  if (const auto* half = std::get_if<HalfSpace>(&part)) {
    const auto k = std::find(halfSpaces.begin(), halfSpaces.end(), *half) - halfSpaces.begin();
    return (triangle.sides >> k) & 1;
  }
  const auto& names = std::get<PatchSet>(part).patches;
  return std::find(names.begin(), names.end(), work.solid->patches()[triangle.patch].name) !=
         names.end();
}

std::vector<int> trianglesOf(const MeshRegion& region, const WorkMesh& work,
                             const std::vector<HalfSpace>& halfSpaces) {
  std::vector<int> triangles;
  for (std::size_t t = 0; t < work.triangles.size(); ++t)
    if (std::any_of(region.where.parts.begin(), region.where.parts.end(), [&](const auto& part) {
          return contains(part, work, work.triangles[t], halfSpaces);
        }))
      triangles.push_back(static_cast<int>(t));
  if (triangles.empty())
    throw ModelingError(region.name +
                        ": no part of the surface lies in this region; check the half space "
                        "(normal · x < below_mm) against the size and place of the solid");
  return triangles;
}

SurfaceMesh finish(WorkMesh& work, const Counts& counts, std::span<const MeshRegion> regions,
                   const std::vector<HalfSpace>& halfSpaces) {
  renumber(work, counts);
  SurfaceMesh mesh;
  for (const WorkNode& node : work.nodes) {
    mesh.positions.push_back(node.position);
    mesh.parameters.push_back(node.at.front());
  }
  const std::vector<int> groups =
      smoothingGroups(*work.solid, sharpEdges(*work.solid, *work.surface));
  for (const WorkTriangle& triangle : work.triangles) {
    mesh.triangles.push_back(triangle.nodes);
    mesh.patchOfTriangle.push_back(triangle.patch);
    mesh.smoothingGroupOfTriangle.push_back(groups[triangle.patch]);
  }
  for (const MeshRegion& region : regions)
    mesh.trianglesOfRegion.push_back(trianglesOf(region, work, halfSpaces));
  return mesh;
}

/// Bits of the half spaces that belong to a region with refineBorder.
std::uint64_t refinedBorders(std::span<const MeshRegion> regions,
                             const std::vector<HalfSpace>& halfSpaces) {
  std::uint64_t bits = 0;
  for (const MeshRegion& region : regions)
    for (const RegionPart& part : region.where.parts)
      if (const auto* half = std::get_if<HalfSpace>(&part); half && region.refineBorder)
        bits |= std::uint64_t{1} << (std::find(halfSpaces.begin(), halfSpaces.end(), *half) -
                                     halfSpaces.begin());
  return bits;
}

/// Patches named in a region with refineBorder: their outer edges are borders, too.
std::set<int> refinedPatches(std::span<const MeshRegion> regions, const Solid& solid) {
  std::set<int> patches;
  for (const MeshRegion& region : regions)
    for (const RegionPart& part : region.where.parts)
      if (const auto* set = std::get_if<PatchSet>(&part); set && region.refineBorder)
        for (const std::string& name : set->patches) patches.insert(*solid.findPatch(name));
  return patches;
}

void refine(MeshEditor& editor, const MeshSettings& settings, std::uint64_t borders,
            const std::set<int>& borderPatches) {
  if (settings.refinementLevels == 0) return;
  const WorkMesh& work = editor.mesh();
  const std::vector<bool> sharp = sharpEdges(*work.solid, *work.surface);
  const auto isSource = [&](int a, int b) {
    const WorkTriangle& left = work.triangles[editor.leftOf(a, b)];
    const WorkTriangle& right = work.triangles[editor.leftOf(b, a)];
    if (settings.refineAtBorders &&
        (((left.sides ^ right.sides) & borders) != 0 ||
         borderPatches.contains(left.patch) != borderPatches.contains(right.patch)))
      return true;
    if (!settings.refineAtSharpEdges || left.patch == right.patch) return false;
    const int edge = work.edgeBetween(a, b);
    return edge >= 0 && sharp[edge];
  };
  refineTowards(editor, isSource, std::ldexp(settings.edgeLength, -settings.refinementLevels),
                settings.edgeLength);
  improveShapes(editor);
}

}  // namespace

void MeshSettings::validate(const std::string& path) const {
  if (!std::isfinite(edgeLength) || edgeLength <= 0.0)
    throw ModelingError(path + ".edge_length_mm: " + numberText(edgeLength) +
                        " must be finite and greater than 0");
  if (refinementLevels < 0 || refinementLevels > kMostLevels)
    throw ModelingError(path + ".refinement.levels: " + std::to_string(refinementLevels) +
                        " is outside 0 … " + std::to_string(kMostLevels));
  std::set<std::string> names;
  for (const auto& [name, factor] : patchFactors) {
    const std::string place = path + ".patch_factors." + name;
    if (!(factor >= kSmallestFactor && factor <= kLargestFactor))
      throw ModelingError(place + ": " + numberText(factor) + " is outside " +
                          numberText(kSmallestFactor) + " … " + numberText(kLargestFactor));
    if (!names.insert(name).second) throw ModelingError(place + ": the patch has a factor already");
  }
}

double estimateNodeCount(const Solid& solid, const MeshSettings& settings,
                         std::span<const MeshRegion> regions) {
  settings.validate();
  const SurfaceEvaluator surface(solid);
  const double plain =
      structuredNodeCount(solid, subdivisionCounts(solid, surface, settings.edgeLength));
  if (settings.refinementLevels == 0) return plain;
  return plain + refinementNodes(solid, surface, settings, regions);
}

SurfaceMesh mesh(const Solid& solid, const MeshSettings& settings,
                 std::span<const MeshRegion> regions) {
  for (const MeshRegion& region : regions) checkRegion(region.where, solid, region.name);
  const double expected = estimateNodeCount(solid, settings, regions);
  if (expected > kMostNodes)
    throw ModelingError("mesh.edge_length_mm: " + numberText(settings.edgeLength) +
                            " mm would need about " + numberText(std::round(expected)) +
                            " nodes; at most " + numberText(kMostNodes) + " are possible",
                        ModelingError::Kind::tooLarge);
  const SurfaceEvaluator surface(solid);
  const Counts counts = subdivisionCounts(solid, surface, settings.edgeLength);
  const std::vector<HalfSpace> halfSpaces = distinctHalfSpaces(regions);
  MeshEditor editor(structuredMesh(solid, surface, counts), halfSpaces);
  for (std::size_t k = 0; k < halfSpaces.size(); ++k) fitToBorder(editor, static_cast<int>(k));
  improveShapes(editor);
  relieveSlivers(editor);
  refine(editor, settings, refinedBorders(regions, halfSpaces), refinedPatches(regions, solid));
  WorkMesh work = editor.take();
  return finish(work, counts, regions, halfSpaces);
}

}  // namespace palpa::modeling
