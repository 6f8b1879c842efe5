#include "modeling/mesh/mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>

#include "base/count_text.h"
#include "base/text.h"
#include "modeling/error.h"
#include "modeling/mesh/border_fit.h"
#include "modeling/mesh/mesh_counts.h"
#include "modeling/mesh/mesh_improve.h"
#include "modeling/mesh/mesh_refine.h"
#include "modeling/mesh/mesh_regions.h"
#include "modeling/mesh/refinement_estimate.h"
#include "modeling/mesh/structured_mesh.h"
#include "modeling/mesh/work_mesh.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::modeling {
namespace {

// Largest distance of a border in the mesh from the true border, of the edge length.
constexpr double kBorderError = 0.1;
// Corner triangles of quadratic elements are twice as long as flat ones of as many nodes, but their
// borders must be as exact: a clamped corner 0.4 mm outside of a support changed its displacements
// by 4 %.
constexpr double kQuadraticBorderError = 0.05;

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
    // Scaled so that equal steps in both directions are equal lengths and the curve's tiles
    // compact.
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

SurfaceMesh finish(WorkMesh& work, const Counts& counts, std::span<const MeshRegion> regions,
                   const std::vector<RegionBorder>& borders) {
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
    mesh.bordersOfTriangle.push_back(triangle.sides);
  }
  mesh.borders = borders;
  for (const MeshRegion& region : regions)
    mesh.trianglesOfRegion.push_back(
        trianglesOf(region, *work.solid, mesh.patchOfTriangle, mesh.bordersOfTriangle, borders));
  return mesh;
}

/// Refines towards the foci; true if there are any.
bool refineAtFoci(MeshEditor& editor, const MeshSettings& settings,
                  std::span<const MeshFocus> foci) {
  bool hasAny = false;
  for (const MeshFocus& focus : foci) {
    if (focus.edgeLength >= settings.edgeLength) continue;
    hasAny = true;
    const auto contains = [&](int triangle) {
      const std::array<int, 3>& nodes = editor.mesh().triangles[triangle].nodes;
      return isAtFocus(
          focus, {editor.position(nodes[0]), editor.position(nodes[1]), editor.position(nodes[2])});
    };
    refineTowards(
        editor,
        [&](int a, int b) {
          return isAtFocus(focus, editor.position(a), editor.position(b)) ||
                 contains(editor.leftOf(a, b)) || contains(editor.leftOf(b, a));
        },
        focus.edgeLength, settings.edgeLength);
  }
  return hasAny;
}

/// True if there are features to refine towards.
bool refineAtFeatures(MeshEditor& editor, const MeshSettings& settings, std::uint64_t borders,
                      const std::set<int>& borderPatches) {
  if (settings.refinementLevels == 0) return false;
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
  return true;
}

}  // namespace

double estimateNodeCount(const Solid& solid, const MeshSettings& settings,
                         std::span<const MeshRegion> regions, std::span<const MeshFocus> foci) {
  // Right triangles with legs of the edge length, bisected once more than needed half of the time.
  constexpr double kAreaPerNode = 0.7;
  settings.validate();
  const SurfaceEvaluator surface(solid);
  const Counts counts = subdivisionCounts(solid, surface, patchEdgeLengths(solid, settings));
  const double plain = structuredNodeCount(solid, counts) + narrowPatchNodes(surface, counts) +
                       strokeNodes(surface, settings, regions) +
                       focusNodes(foci, settings.edgeLength, kAreaPerNode);
  if (settings.refinementLevels == 0) return plain;
  return plain + refinementNodes(solid, surface, settings, regions);
}

SurfaceMesh mesh(const Solid& solid, const MeshSettings& settings,
                 std::span<const MeshRegion> regions, const Job& job,
                 std::span<const MeshFocus> foci) {
  const auto report = [&](double fraction) {
    job.throwIfCancelled();
    job.report(Phase::kMesh, fraction);
  };
  report(0.0);
  for (const MeshRegion& region : regions) checkRegion(region.where, solid, region.name);
  for (const auto& [name, factor] : settings.patchFactors)
    if (!solid.findPatch(name))
      throw ModelingError("mesh.patch_factors: there is no patch \"" + name +
                          "\"; the patches are " + quotedPatchNames(solid));
  const double expected = estimateNodeCount(solid, settings, regions, foci);
  if (expected > kMaxNodes)
    throw ModelingError("mesh.edge_length_mm: " + numberText(settings.edgeLength) +
                            " mm would need about " + estimateText(expected) + " nodes; at most " +
                            countText(kMaxNodes) + " are possible; choose a longer edge",
                        ModelingError::Kind::kTooLarge);
  const SurfaceEvaluator surface(solid);
  const std::vector<double> lengths = patchEdgeLengths(solid, settings);
  const Counts counts = subdivisionCounts(solid, surface, lengths, job);
  const std::vector<RegionBorder> borders = distinctBorders(regions);
  report(0.05);
  MeshEditor editor(structuredMesh(solid, surface, counts, lengths, job), borders, job);
  boundAspect(editor, narrowPatches(surface, counts), longPatches(surface, counts));
  report(0.3);
  const double borderError =
      settings.engine == Engine::kQuadratic ? kQuadraticBorderError : kBorderError;
  for (std::size_t k = 0; k < borders.size(); ++k)
    fitToBorder(editor, static_cast<int>(k), borderError);
  report(0.5);
  improveShapes(editor);
  // Refined borders must be as exact as the finest triangles.
  const int levels = settings.refineAtBorders ? settings.refinementLevels : 0;
  const double shortest = *std::min_element(lengths.begin(), lengths.end());
  closeWedges(editor, std::ldexp(borderError * shortest, -levels));
  relieveSlivers(editor);
  report(0.6);
  const bool isGraded = refineAtFeatures(editor, settings, refinedBorders(regions, borders),
                                         refinedPatches(regions, solid));
  if (refineAtFoci(editor, settings, foci) || isGraded) improveShapes(editor);
  report(0.9);
  WorkMesh work = editor.take();
  SurfaceMesh result = finish(work, counts, regions, borders);
  report(1.0);
  return result;
}

}  // namespace palpa::modeling
