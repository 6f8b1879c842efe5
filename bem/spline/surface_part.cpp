#include "bem/spline/surface_part.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "bem/spline/border_extension.h"
#include "bem/spline/element_cutter.h"
#include "bem/spline/spline_projection.h"

namespace palpa::bem {
namespace {

/// Share of a function's area on one side of the border, or on one face there, below which it
/// counts for the other side. The rounding error of the factorisation grows like the inverse of the
/// share: a smaller share would cost more digits than the function contributes. In single precision
/// four digits are left.
constexpr double kMinShare = 1e-3;

/// Areas of the functions, ∫ N_j dΓ, on elements inside and outside a part.
struct Areas {
  std::vector<double> inside, outside;
  std::vector<std::map<int, double>> insideOfGroup;  ///< by smoothing group
};

Areas areasOf(const SplineSurface& surface, const std::vector<bool>& isInside) {
  const std::size_t count = surface.controlPoints().size();
  Areas areas{std::vector<double>(count, 0), std::vector<double>(count, 0),
              std::vector<std::map<int, double>>(count)};
  std::vector<int> all(surface.elements().size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<double> basis;
  visitSplinePoints(surface, all, 4, std::numeric_limits<double>::infinity(),
                    [&](const ElementPlace& place, const SurfaceJet&, double weight) {
                      surface.evaluateBasis(place, basis);
                      for (std::size_t f = 0; f < basis.size(); ++f) {
                        const int k = surface.functions(place.element)[f];
                        const double area = weight * basis[f];
                        (isInside[place.element] ? areas.inside : areas.outside)[k] += area;
                        if (isInside[place.element])
                          areas.insideOfGroup[k][surface.smoothingGroup(place.element)] += area;
                      }
                    });
  return areas;
}

/// Pieces of an element; none if the border of the part does not cut it. `isInside` receives
/// whether the whole element is inside.
std::vector<ElementPiece> piecesOf(const SplineSurface& surface, int element,
                                   const SurfacePart& part, bool hasRoots, bool& isInside) {
  const SurfacePart::OnPatch here = part.on(surface.elements()[element].patch);
  isInside = here.isWhole;
  if (!here.level) return {};
  const SplineElement& e = surface.elements()[element];
  const Eigen::Vector3d middle =
      surface.evaluate({element, (e.lower[0] + e.upper[0]) / 2, (e.lower[1] + e.upper[1]) / 2})
          .position;
  // The element lies in the convex hull of its control points.
  double radius = 0;
  for (const int point : surface.net(element))
    radius = std::max(radius, (surface.controlPoints()[point] - middle).norm());
  const double level = here.level(middle);
  isInside = level < 0;
  if (std::abs(level) > radius) return {};
  std::vector<ElementPiece> pieces = cutElement(surface, element, here.level, hasRoots);
  if (pieces.size() > 1) return pieces;
  isInside = pieces.front().isInside;
  return {};
}

/// Functions whose elements in one patch lie on both sides of the border, whether it cuts elements
/// or runs along knots. Along the edge of a patch no function needs tearing, because functions do
/// not extend across it.
std::vector<bool> cutFunctions(const SplineSurface& surface, const std::vector<bool>& isInside) {
  std::vector<std::map<int, bool>> sideInPatch(surface.controlPoints().size());
  std::vector<bool> isCut(surface.controlPoints().size(), false);
  for (int e = 0; e < surface.elementCount(); ++e)
    for (const int k : surface.functions(e)) {
      const auto [side, isFirst] =
          sideInPatch[k].try_emplace(surface.elements()[e].patch, isInside[e]);
      if (side->second != isInside[e]) isCut[k] = true;
    }
  return isCut;
}

/// Gives the functions that the border of a part cuts one coefficient per side.
void tearAtBorder(SplineSurface& surface, const std::vector<bool>& isInside) {
  const std::vector<bool> isCut = cutFunctions(surface, isInside);
  const Areas areas = areasOf(surface, isInside);
  for (std::size_t k = 0; k < isCut.size(); ++k) {
    if (!isCut[k]) continue;
    int coefficient = static_cast<int>(k);
    const double whole = areas.inside[k] + areas.outside[k], share = areas.inside[k] / whole;
    if (share >= kMinShare && share <= 1 - kMinShare)
      coefficient = surface.tear(coefficient, isInside);
    for (const auto& [group, area] : areas.insideOfGroup[k]) {
      if (area >= kMinShare * whole) continue;
      for (int e = 0; e < surface.elementCount(); ++e)
        if (isInside[e] && surface.smoothingGroup(e) == group &&
            std::count(surface.functions(e).begin(), surface.functions(e).end(), coefficient) > 0)
          surface.setBarelyReaches(coefficient, surface.elements()[e].tag, group);
    }
  }
}

/// Gives elements along whose sides a border runs, uncut, the root of the distance as coordinate.
void addRootsAlongSides(SplineSurface& surface, const LevelFunction& level) {
  constexpr double kNear = 2 * kThinnestSlice;  // of the element's extent across
  const auto place = [](const SplineElement& e, int axis, double across, double along) {
    std::array<double, 2> at{};
    at[axis] = e.lower[axis] + across * (e.upper[axis] - e.lower[axis]);
    at[1 - axis] = e.lower[1 - axis] + along * (e.upper[1 - axis] - e.lower[1 - axis]);
    return at;
  };
  for (int index = 0; index < surface.elementCount(); ++index) {
    SplineElement element = surface.elements()[index];
    if (surface.isCut(index)) continue;
    const auto levelAt = [&](int axis, double across, double along) {
      const auto at = place(element, axis, across, along);
      return std::abs(level(surface.evaluate({index, at[0], at[1]}).position));
    };
    for (const int axis : {0, 1})
      for (const int side : {0, 1}) {
        if (surface.isCut(index)) continue;
        bool isAlong = true;
        for (int k = 0; k < kBorderSamples && isAlong; ++k) {
          const double along = k / (kBorderSamples - 1.0);
          isAlong = levelAt(axis, side, along) < kNear * levelAt(axis, 1 - side, along);
        }
        if (!isAlong) continue;
        CutMap::Values lower{}, upper{};
        lower.fill(element.lower[axis]);
        upper.fill(element.upper[axis]);
        const CutMap map(1 - axis, element.lower[1 - axis], element.upper[1 - axis], lower, upper,
                         side == 0 ? CutMap::Root::kLower : CutMap::Root::kUpper);
        element.lower = {0, 0};
        element.upper = {1, 1};
        surface.replaceElement(index, {element}, {map});
      }
  }
}

/// Gives the elements beside the border of a part functions with roots.
void addBorder(SplineSurface& surface, const SurfacePart& part, const std::vector<bool>& isInside) {
  std::vector<LevelFunction> levels;
  for (const CutBorder& border : surface.cutBorders()) levels.push_back(border.level);
  if (part.level) levels.push_back(part.level);
  const int side = part.level ? static_cast<int>(levels.size()) - 1 : SplineSurface::kFixedPatch;
  for (int e = 0; e < surface.elementCount(); ++e)
    if (isInside[e]) surface.setSide(e, side);
  if (part.level) addRootsAlongSides(surface, part.level);
  if (!levels.empty()) extendAtBorders(surface, levels);
}

}  // namespace

SurfacePart::OnPatch SurfacePart::on(int patch) const {
  if (lacksPatch(patch)) return {};
  if (hasPatch(patch)) {
    if (!exceptLevel) return {true, {}};
    return {false, [this](const Eigen::Vector3d& x) { return -exceptLevel(x); }};
  }
  if (!level || !exceptLevel) return {false, level};
  return {false, [this](const Eigen::Vector3d& x) { return std::max(level(x), -exceptLevel(x)); }};
}

SplineSurface withPart(const SplineSurface& surface, const SurfacePart& part,
                       const std::function<int(int)>& tagInside, Tearing tearing) {
  SplineSurface result = surface;
  std::vector<bool> isInside(surface.elements().size(), false);
  for (int e = 0; e < surface.elementCount(); ++e) {
    bool isWholeInside = false;
    std::vector<ElementPiece> pieces =
        piecesOf(surface, e, part, tearing == Tearing::kRoots, isWholeInside);
    isInside[e] = isWholeInside;
    if (pieces.empty()) continue;
    isInside[e] = pieces.front().isInside;
    std::vector<SplineElement> elements;
    std::vector<std::optional<CutMap>> maps;
    for (ElementPiece& piece : pieces) {
      SplineElement element = surface.elements()[e];
      element.lower = piece.map ? std::array<double, 2>{0, 0} : piece.rectangle.lower;
      element.upper = piece.map ? std::array<double, 2>{1, 1} : piece.rectangle.upper;
      if (!elements.empty()) isInside.push_back(piece.isInside);
      elements.push_back(element);
      maps.push_back(std::move(piece.map));
    }
    result.replaceElement(e, elements, maps);
  }
  for (int e = 0; e < result.elementCount(); ++e) {
    if (!isInside[e]) continue;
    const int before = result.elements()[e].tag, after = tagInside(before);
    if (after == before) isInside[e] = false;  // belongs to another part: no border of this one
    result.setTag(e, after);
    const int group = result.smoothingGroup(e);
    for (const int function : result.functions(e))
      if (result.barelyReaches(function, before, group))
        result.setBarelyReaches(function, after, group);
  }
  if (tearing == Tearing::kTorn) tearAtBorder(result, isInside);
  if (tearing == Tearing::kRoots) addBorder(result, part, isInside);
  return result;
}

SplineSurface withPart(const SplineSurface& surface, const LevelFunction& level, int tag,
                       Tearing tearing) {
  return withPart(
      surface, SurfacePart{{}, level}, [tag](int) { return tag; }, tearing);
}

}  // namespace palpa::bem
