#include "modeling/mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "modeling/error.h"
#include "modeling/mesh_counts.h"
#include "modeling/structured_mesh.h"
#include "modeling/surface_properties.h"
#include "modeling/text.h"
#include "modeling/work_mesh.h"

namespace palpa::modeling {
namespace {

constexpr int kMostLevels = 6;

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

/// The true surface point in the middle (in parameters) of each triangle.
std::vector<Eigen::Vector3d> centroids(const WorkMesh& work) {
  std::vector<Eigen::Vector3d> points;
  for (const WorkTriangle& triangle : work.triangles) {
    double u = 0.0;
    double v = 0.0;
    for (int node : triangle.nodes) {
      u += work.in(node, triangle.patch).u / 3.0;
      v += work.in(node, triangle.patch).v / 3.0;
    }
    points.push_back(work.surface->position(triangle.patch, u, v));
  }
  return points;
}

bool contains(const RegionPart& part, const Solid& solid, int patch, const Eigen::Vector3d& x,
              double tolerance) {
  if (const auto* half = std::get_if<HalfSpace>(&part))
    return half->value(x) < -tolerance * half->normal.norm();
  for (const std::string& name : std::get<PatchSet>(part).patches)
    if (solid.patches()[patch].name == name) return true;
  return false;
}

std::vector<int> trianglesOf(const MeshRegion& region, const WorkMesh& work,
                             const std::vector<Eigen::Vector3d>& middles, double tolerance) {
  std::vector<int> triangles;
  for (std::size_t t = 0; t < middles.size(); ++t)
    for (const RegionPart& part : region.where.parts)
      if (contains(part, *work.solid, work.triangles[t].patch, middles[t], tolerance)) {
        triangles.push_back(static_cast<int>(t));
        break;
      }
  if (triangles.empty())
    throw ModelingError(region.name +
                        ": no part of the surface lies in this region; check the half space "
                        "(normal · x < below_mm) against the size and place of the solid");
  return triangles;
}

SurfaceMesh finish(WorkMesh& work, const Counts& counts, std::span<const MeshRegion> regions) {
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
  const std::vector<Eigen::Vector3d> middles = centroids(work);
  // A face lying in the border plane itself must not be chosen by rounding.
  const auto [low, high] = boundingBox(*work.solid);
  const double tolerance = 1e-9 * (high - low).norm();
  for (const MeshRegion& region : regions)
    mesh.trianglesOfRegion.push_back(trianglesOf(region, work, middles, tolerance));
  return mesh;
}

}  // namespace

void MeshSettings::validate(const std::string& path) const {
  if (!std::isfinite(edgeLength) || edgeLength <= 0.0)
    throw ModelingError(path + ".edge_length_mm: " + numberText(edgeLength) +
                        " must be finite and greater than 0");
  if (refinementLevels < 0 || refinementLevels > kMostLevels)
    throw ModelingError(path + ".refinement.levels: " + std::to_string(refinementLevels) +
                        " is outside 0 … " + std::to_string(kMostLevels));
}

double estimateNodeCount(const Solid& solid, const MeshSettings& settings) {
  settings.validate();
  const SurfaceEvaluator surface(solid);
  return structuredNodeCount(solid, subdivisionCounts(solid, surface, settings.edgeLength));
}

SurfaceMesh mesh(const Solid& solid, const MeshSettings& settings,
                 std::span<const MeshRegion> regions) {
  const double expected = estimateNodeCount(solid, settings);
  if (expected > kMostNodes)
    throw ModelingError("mesh.edge_length_mm: " + numberText(settings.edgeLength) +
                            " mm would need about " + numberText(std::round(expected)) +
                            " nodes; at most " + numberText(kMostNodes) + " are possible",
                        ModelingError::Kind::tooLarge);
  for (const MeshRegion& region : regions) checkRegion(region.where, solid, region.name);
  const SurfaceEvaluator surface(solid);
  const Counts counts = subdivisionCounts(solid, surface, settings.edgeLength);
  WorkMesh work = structuredMesh(solid, surface, counts);
  return finish(work, counts, regions);
}

}  // namespace palpa::modeling
