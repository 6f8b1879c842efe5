#include "app/core/setup/support_borders.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "modeling/mesh/region_border.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;

constexpr int kMinSamples = 24, kMaxSamples = 96;  ///< pieces of a patch per direction
constexpr double kInwards = 0.01;  ///< distance of samples from an edge, in the patch's size

/// True if a part ends along most of an edge.
bool endsAlong(const modeling::SurfaceEvaluator& surface, const modeling::SolidEdge& edge,
               const bem::SurfacePart& part) {
  constexpr int kPlaces = 5;
  int differ = 0;
  for (int k = 0; k < kPlaces; ++k) {
    std::array<bool, 2> isInside{};
    for (int use = 0; use < 2; ++use) {
      const modeling::PatchEdge& at = edge.uses[use];
      const int along = directionOf(at.side);
      const bool isUpper = at.side == modeling::Side::kUMax || at.side == modeling::Side::kVMax;
      const double fraction = (k + 0.5) / kPlaces;
      std::array<double, 2> fractions{};
      fractions[along] = use == 1 && edge.reversed ? 1 - fraction : fraction;
      fractions[1 - along] = isUpper ? 1 - kInwards : kInwards;
      std::array<double, 2> parameter{};
      for (int d = 0; d < 2; ++d) {
        const auto [low, high] = surface.range(at.patch, d);
        parameter[d] = low + fractions[d] * (high - low);
      }
      isInside[use] =
          part.on(at.patch).contains(surface.position(at.patch, parameter[0], parameter[1]));
    }
    differ += isInside[0] != isInside[1] ? 1 : 0;
  }
  return 2 * differ > kPlaces;
}

/// Samples of a patch in a grid, and the places between them where a level function changes sign.
class PatchSamples {
 public:
  PatchSamples(const modeling::SurfaceEvaluator& surface, int patch, int pieces,
               const bem::LevelFunction& level)
      : patch_(patch), pieces_(pieces) {
    for (int d = 0; d < 2; ++d) range_[d] = surface.range(patch, d);
    for (int j = 0; j <= pieces; ++j)
      for (int i = 0; i <= pieces; ++i) {
        positions_.push_back(surface.position(patch, parameter(0, i), parameter(1, j)));
        levels_.push_back(level(positions_.back()));
      }
  }

  void addPlaces(double radius, std::vector<SupportBorders::Place>& places) const {
    for (int j = 0; j <= pieces_; ++j)
      for (int i = 0; i <= pieces_; ++i)
        for (int d = 0; d < 2; ++d) {
          const std::array<int, 2> next{i + (d == 0 ? 1 : 0), j + (d == 1 ? 1 : 0)};
          if (next[d] > pieces_) continue;
          const double here = levels_[index(i, j)], there = levels_[index(next[0], next[1])];
          if ((here < 0) == (there < 0)) continue;
          SupportBorders::Place place{patch_, {parameter(0, i), parameter(1, j)}, {}, radius};
          place.parameters[d] += here / (here - there) * (range_[d][1] - range_[d][0]) / pieces_;
          const std::array<double, 2> slope{slopeAlong(0, i, j), slopeAlong(1, i, j)};
          const double size = std::hypot(slope[0], slope[1]);
          if (!(size > 0)) continue;
          for (int e = 0; e < 2; ++e) place.along[e] = std::abs(slope[e]) / size;
          places.push_back(place);
        }
  }

 private:
  double parameter(int d, int k) const {
    return range_[d][0] + (range_[d][1] - range_[d][0]) * k / pieces_;
  }
  int index(int i, int j) const { return i + j * (pieces_ + 1); }
  double slopeAlong(int d, int i, int j) const {
    const int k = d == 0 ? i : j, low = std::max(k - 1, 0), high = std::min(k + 1, pieces_);
    const int a = d == 0 ? index(low, j) : index(i, low);
    const int b = d == 0 ? index(high, j) : index(i, high);
    const double length = (positions_[b] - positions_[a]).norm();
    return length > 0 ? (levels_[b] - levels_[a]) / length : 0;
  }

  int patch_, pieces_;
  std::array<std::array<double, 2>, 2> range_{};
  std::vector<Vector3d> positions_;
  std::vector<double> levels_;
};

double thinnestStroke(const modeling::Region& region) {
  double radius = std::numeric_limits<double>::infinity();
  for (const auto* parts : {&region.parts, &region.except})
    for (const modeling::RegionPart& part : *parts)
      if (const auto* stroke = std::get_if<modeling::Stroke>(&part))
        radius = std::min(radius, stroke->radius);
  return radius;
}

/// Distance from the half spaces and strokes; null without any.
bem::LevelFunction levelOf(const std::vector<modeling::RegionPart>& parts) {
  std::vector<modeling::RegionBorder> borders;
  std::vector<modeling::Stroke> strokes;
  for (const modeling::RegionPart& part : parts) {
    if (const auto* half = std::get_if<modeling::HalfSpace>(&part))
      borders.emplace_back(*half);
    else if (const auto* stroke = std::get_if<modeling::Stroke>(&part))
      strokes.push_back(*stroke);
  }
  if (!strokes.empty()) borders.emplace_back(std::move(strokes));
  if (borders.empty()) return {};
  return [shared = std::make_shared<const std::vector<modeling::RegionBorder>>(std::move(borders))](
             const Vector3d& x) {
    double least = std::numeric_limits<double>::infinity();
    for (const modeling::RegionBorder& border : *shared)
      least = std::min(least, border.value(x) / border.slope());
    return least;
  };
}

/// True if the border of a half space crosses no sharp edge, and the surface beside it is steep.
bool isRegular(const modeling::HalfSpace& half, const modeling::Solid& solid,
               const modeling::SurfaceEvaluator& surface) {
  constexpr int kPieces = 32;
  constexpr double kBeside = 0.03;    ///< of the size of the body
  constexpr double kMinSlope = 0.35;  ///< change of the distance per distance along the surface
  const auto [low, high] = modeling::boundingBox(solid);
  const double band = kBeside * (high - low).norm();
  const Vector3d normal = half.normal.normalized();
  const std::vector<int> groups =
      modeling::smoothingGroups(solid, modeling::sharpEdges(solid, surface));
  std::optional<int> cut;
  for (int patch = 0; patch < surface.patchCount(); ++patch) {
    const auto [uLow, uHigh] = surface.range(patch, 0);
    const auto [vLow, vHigh] = surface.range(patch, 1);
    bool isInside = false, isOutside = false;
    for (int j = 0; j <= kPieces; ++j)
      for (int i = 0; i <= kPieces; ++i) {
        const double u = uLow + (uHigh - uLow) * i / kPieces;
        const double v = vLow + (vHigh - vLow) * j / kPieces;
        const double level = half.value(surface.position(patch, u, v)) / half.normal.norm();
        (level < 0 ? isInside : isOutside) = true;
        if (std::abs(level) > band) continue;
        const double across = normal.dot(surface.normal(patch, u, v));
        if (1 - across * across < kMinSlope * kMinSlope) return false;
      }
    if (!isInside || !isOutside) continue;
    const int group = groups[static_cast<std::size_t>(patch)];
    if (cut && *cut != group) return false;
    cut = group;
  }
  return true;
}

}  // namespace

bool haveRoots(std::span<const modeling::Support> supports, const modeling::Solid& solid,
               const modeling::SurfaceEvaluator& surface) {
  const auto isPatches = [](const modeling::RegionPart& part) {
    return std::holds_alternative<modeling::PatchSet>(part);
  };
  return std::all_of(supports.begin(), supports.end(), [&](const modeling::Support& support) {
    const auto& [parts, except] = support.where;
    if (std::all_of(parts.begin(), parts.end(), isPatches) &&
        std::all_of(except.begin(), except.end(), isPatches))
      return true;
    const auto* half =
        parts.size() == 1 ? std::get_if<modeling::HalfSpace>(&parts.front()) : nullptr;
    return half && except.empty() && support.kind == modeling::Support::Kind::kFixed &&
           isRegular(*half, solid, surface);
  });
}

bem::SurfacePart surfacePart(const modeling::Region& region, const modeling::Solid& solid) {
  return {modeling::namedPatches(region.parts, solid), levelOf(region.parts),
          modeling::namedPatches(region.except, solid), levelOf(region.except)};
}

SupportBorders supportBorders(const modeling::Solid& solid,
                              const modeling::SurfaceEvaluator& surface,
                              std::span<const modeling::Region> supports) {
  SupportBorders borders;
  borders.edges.resize(solid.edges().size(), false);
  for (const modeling::Region& region : supports) {
    const bem::SurfacePart part = surfacePart(region, solid);
    for (std::size_t e = 0; e < solid.edges().size(); ++e)
      if (endsAlong(surface, solid.edges()[e], part)) borders.edges[e] = true;
    const double radius = thinnestStroke(region);
    for (int patch = 0; patch < surface.patchCount(); ++patch) {
      const bem::SurfacePart::OnPatch here = part.on(patch);
      if (!here.level) continue;
      double reach = 0;  // of the patch's control points about one of them
      const auto& net = solid.patches()[patch].net;
      const Vector3d& first = solid.controlPoints()[net[0][0]];
      for (const auto& row : net)
        for (const int point : row)
          reach = std::max(reach, (solid.controlPoints()[point] - first).norm());
      if (std::abs(here.level(first)) > reach) continue;
      const int pieces =
          std::clamp(static_cast<int>(std::min(3 * reach / radius, 1e6)), kMinSamples, kMaxSamples);
      PatchSamples(surface, patch, pieces, here.level).addPlaces(radius, borders.places);
    }
  }
  return borders;
}

}  // namespace palpa::app
