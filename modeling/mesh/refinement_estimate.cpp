#include "modeling/mesh/refinement_estimate.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "modeling/mesh/mesh_refine.h"
#include "modeling/mesh/mesh_regions.h"
#include "modeling/solid/edge_curve.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::modeling {
namespace {

double edgeLength(const SurfaceEvaluator& surface, PatchEdge edge) {
  const SurfaceParameter start = onSide(surface, edge, 0.0);
  const int direction = directionOf(edge.side);
  return IsoCurve(surface, edge.patch, direction, direction == 0 ? start.v : start.u).length();
}

/// Length of the border on the patches, by linear interpolation in a grid of triangles.
double borderLength(const SurfaceEvaluator& surface, const RegionBorder& border) {
  constexpr int kCells = 16;
  double length = 0.0;
  for (int patch = 0; patch < surface.patchCount(); ++patch) {
    const auto uRange = surface.range(patch, 0);
    const auto vRange = surface.range(patch, 1);
    const auto point = [&](int i, int j) {
      return surface.position(patch, uRange[0] + (uRange[1] - uRange[0]) * i / kCells,
                              vRange[0] + (vRange[1] - vRange[0]) * j / kCells);
    };
    const auto crossed = [&](const std::array<Eigen::Vector3d, 3>& corners) {
      std::vector<Eigen::Vector3d> ends;
      for (int k = 0; k < 3; ++k) {
        const double a = border.value(corners[k]);
        const double b = border.value(corners[(k + 1) % 3]);
        if ((a < 0.0) != (b < 0.0))
          ends.push_back(corners[k] + a / (a - b) * (corners[(k + 1) % 3] - corners[k]));
      }
      return ends.size() == 2 ? (ends[1] - ends[0]).norm() : 0.0;
    };
    for (int i = 0; i < kCells; ++i)
      for (int j = 0; j < kCells; ++j)
        length += crossed({point(i, j), point(i + 1, j), point(i + 1, j + 1)}) +
                  crossed({point(i, j), point(i + 1, j + 1), point(i, j + 1)});
  }
  return length;
}

}  // namespace

double strokeNodes(const SurfaceEvaluator& surface, const MeshSettings& settings,
                   std::span<const MeshRegion> regions) {
  // Triangles are bisected until their longest edge is between the wanted length c and 0.6 c, in a
  // band of width c on both sides of the border. The factor for the grading around it is measured.
  constexpr double kAreaPerNode = 0.36;  // over c²
  constexpr double kGraded = 2.0;
  const double longest = std::numbers::sqrt2 * settings.edgeLength;
  double sum = 0.0;
  double most = 0.0;  // nodes per area
  for (const RegionBorder& border : distinctBorders(regions))
    for (const Stroke& stroke : border.strokes()) {
      double length = 0.0;
      for (std::size_t i = 1; i < stroke.points.size(); ++i)
        length += (stroke.points[i] - stroke.points[i - 1]).norm();
      for (const bool nearEnd : {true, false}) {
        const double c = strokeEdge(stroke.radius, longest, nearEnd);
        if (c >= longest) continue;
        const double outer = stroke.radius + c;
        const double inner = std::max(0.0, stroke.radius - c);
        const double band = nearEnd ? std::numbers::pi * (outer * outer - inner * inner)
                                    : 2.0 * length * (outer - inner);
        const double perArea = 1.0 / (kAreaPerNode * c * c);
        sum += kGraded * band * perArea;
        most = std::max(most, perArea);
      }
    }
  return std::min(sum, most * area(surface));
}

double refinementNodes(const Solid& solid, const SurfaceEvaluator& surface,
                       const MeshSettings& settings, std::span<const MeshRegion> regions) {
  std::set<int> patches;
  double length = 0.0;
  if (settings.refineAtBorders) {
    const std::vector<RegionBorder> borders = distinctBorders(regions);
    const std::uint64_t refined = refinedBorders(regions, borders);
    for (std::size_t k = 0; k < borders.size(); ++k)
      if ((refined >> k) & 1) length += borderLength(surface, borders[k]);
    for (const MeshRegion& region : regions)
      for (const RegionPart& part : region.where.parts) {
        if (!region.isSupport) continue;
        if (const auto* set = std::get_if<PatchSet>(&part))
          for (const std::string& name : set->patches) patches.insert(*solid.findPatch(name));
      }
  }
  const std::vector<bool> sharp = sharpEdges(solid, surface);
  for (std::size_t e = 0; e < solid.edges().size(); ++e) {
    const auto& uses = solid.edges()[e].uses;
    const bool isBorder = patches.contains(uses[0].patch) != patches.contains(uses[1].patch);
    if ((settings.refineAtSharpEdges && sharp[e]) || isBorder)
      length += edgeLength(surface, uses[0]);
  }
  const double h = settings.edgeLength;
  const double a = std::ldexp(h, -settings.refinementLevels);
  const double perSide = ((1.0 / a - 1.0 / h) / kSizeGrowth) - (h - a) / (kSizeGrowth * h * h);
  const double everywhere = area(surface) * (1.0 / (a * a) - 1.0 / (h * h));
  // Bisection overshoots: pieces are between the wanted size and 1/√2 of it. Measured on sphere,
  // cylinder and box with 1 to 4 levels: 1.4 to 2 times the integral.
  constexpr double kOvershoot = 1.6;
  return std::min(2.0 * kOvershoot * length * perSide, 2.0 * everywhere);
}

}  // namespace palpa::modeling
