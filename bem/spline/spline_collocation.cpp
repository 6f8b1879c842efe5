#include "bem/spline/spline_collocation.h"

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>

#include "bem/base/gauss_rule.h"
#include "bem/spline/spline_nearest.h"

namespace palpa::bem {
namespace {

/// Smallest distance of a collocation point from the border of a support, over the width of the
/// border's weight: nearer points have nearly the same equation on both sides. From 0.01 to 0.1
/// the errors hardly differ.
constexpr double kMinDistance = 0.05;
constexpr double kEnough = kMinDistance * (1 - 1e-9);  ///< with rounding

bool carries(const SplineSurface& surface, int element, int coefficient) {
  const std::vector<int>& list = surface.net(element);
  if (!surface.owners().empty() && surface.side(element) != surface.owners()[coefficient])
    return false;
  return std::find(list.begin(), list.end(), coefficient) != list.end();
}

/// Places for a function whose Greville point lies on the other side of the border: the mean
/// position on the elements that use the coefficient, weighted by the squared function, in the
/// patch with the largest weight. Where faces meet at a sharp edge, the first face is used.
std::vector<ElementPlace> placesOnOwnSide(const SplineSurface& surface, int coefficient) {
  int group = std::numeric_limits<int>::max();
  for (int e = 0; e < surface.elementCount(); ++e)
    if (carries(surface, e, coefficient)) group = std::min(group, surface.smoothingGroup(e));
  const auto isOwn = [&](int e) { return surface.smoothingGroup(e) == group; };
  constexpr int kPoints = 4;
  const GaussRule& rule = gaussRule(kPoints);
  struct Middle {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    double weight = 0;
  };
  std::map<int, Middle> middles;  // by patch
  ElementPlace strongest{-1, 0, 0};
  double most = 0;
  std::vector<double> basis;
  for (int e = 0; e < surface.elementCount(); ++e) {
    if (!isOwn(e) || !carries(surface, e, coefficient)) continue;
    const SplineElement& element = surface.elements()[e];
    for (int i = 0; i < kPoints; ++i)
      for (int j = 0; j < kPoints; ++j) {
        const ElementPlace place{
            e, element.lower[0] + rule.points[i] * (element.upper[0] - element.lower[0]),
            element.lower[1] + rule.points[j] * (element.upper[1] - element.lower[1])};
        surface.evaluateNet(e, surface.parameters(place).parameters, basis);
        double value = 0;
        for (std::size_t f = 0; f < basis.size(); ++f)
          if (surface.net(e)[f] == coefficient) value += basis[f];
        const double weight = value * value * rule.weights[i] * rule.weights[j] *
                              surface.evaluate(place).areaVector().norm();
        middles[element.patch].sum += weight * surface.parameters(place).parameters;
        middles[element.patch].weight += weight;
        if (value > most) {
          most = value;
          strongest = place;
        }
      }
  }
  const auto heaviest = std::max_element(
      middles.begin(), middles.end(),
      [](const auto& a, const auto& b) { return a.second.weight < b.second.weight; });
  const Eigen::Vector2d middle = heaviest->second.sum / heaviest->second.weight;
  const auto places = placesInPatch(surface, heaviest->first, middle[0], middle[1]);
  if (!places.empty() && std::all_of(places.begin(), places.end(), [&](const ElementPlace& p) {
        return isOwn(p.element) && carries(surface, p.element, coefficient);
      }))
    return places;
  const Eigen::Vector2d at = surface.parameters(strongest).parameters;
  return placesInPatch(surface, surface.elements()[strongest.element].patch, at[0], at[1]);
}

/// Rectangle of a patch in which the collocation point of a function stays, so that no two
/// functions have the same point.
struct Cell {
  Eigen::Vector2d low, high;

  Cell(const SplineSurface& surface, const SplineOccurrence& function) {
    constexpr double kShare = 0.4;  // of the way to the next Greville point
    const std::array<int, 2> number{function.i, function.j};
    for (int d = 0; d < 2; ++d) {
      const BsplineBasis& basis = surface.patches()[function.patch].basis[d];
      const int last = basis.count() - 1;
      const double own = basis.greville(number[d]);
      low[d] = own + kShare * (basis.greville(std::max(number[d] - 1, 0)) - own);
      high[d] = own + kShare * (basis.greville(std::min(number[d] + 1, last)) - own);
    }
  }
};

/// Moves points that are too close to the border of a support away from it, into the side to which
/// their function belongs.
class BorderDistance {
 public:
  BorderDistance(const SplineSurface& surface, int coefficient)
      : surface_(surface), owner_(surface.owners()[coefficient]) {}

  /// Smallest distance from a border over its width; negative on the other side.
  double at(const Eigen::Vector3d& x) const {
    if (owner_ >= 0) return -signedDistance(owner_, x);
    double least = 1;
    for (std::size_t k = 0; k < surface_.cutBorders().size(); ++k)
      least = std::min(least, signedDistance(static_cast<int>(k), x));
    return least;
  }

  double inPatch(int patch, const Eigen::Vector2d& parameters) const {
    return at(
        surface_.evaluate(placesInPatch(surface_, patch, parameters[0], parameters[1]).front())
            .position);
  }

  /// Parameters of a patch, moved along the gradient within a cell; along an edge of the patch if
  /// that leads far enough.
  Eigen::Vector2d moved(int patch, const Eigen::Vector2d& at, const Cell& cell) const {
    const Eigen::Vector2d alongEdge = moved(patch, at, cell, true);
    const double distance = inPatch(patch, alongEdge);
    if (distance >= kEnough) return alongEdge;
    const Eigen::Vector2d anywhere = moved(patch, at, cell, false);
    return inPatch(patch, anywhere) > distance ? anywhere : alongEdge;
  }

 private:
  Eigen::Vector2d moved(int patch, Eigen::Vector2d at, const Cell& cell, bool staysOnEdge) const {
    constexpr int kMaxSteps = 10;
    constexpr double kStep = 1e-5, kMinAlongEdge = 0.1;
    const auto& basis = surface_.patches()[patch].basis;
    std::array<bool, 2> isOnEdge{};
    Eigen::Vector2d low, high;
    for (int d = 0; d < 2; ++d) {
      low[d] = basis[d].knots().front();
      high[d] = basis[d].knots().back();
      const double slack = 1e-9 * (high[d] - low[d]);
      isOnEdge[d] = at[d] < low[d] + slack || at[d] > high[d] - slack;
    }
    for (int step = 0; step < kMaxSteps; ++step) {
      const double here = inPatch(patch, at);
      if (here >= kEnough) break;
      Eigen::Vector2d slope;
      for (int d = 0; d < 2; ++d) {
        const Eigen::Vector2d by = kStep * (high[d] - low[d]) * Eigen::Vector2d::Unit(d);
        const Eigen::Vector2d before = (at - by).cwiseMax(low), after = (at + by).cwiseMin(high);
        slope[d] = (inPatch(patch, after) - inPatch(patch, before)) / (after - before).norm();
      }
      const Eigen::Vector2d scaled = slope.cwiseProduct(high - low);
      for (int d = 0; staysOnEdge && d < 2; ++d)
        if (isOnEdge[d] && std::abs(scaled[1 - d]) > kMinAlongEdge * std::abs(scaled[d]))
          slope[d] = 0;
      const double square = (slope.cwiseProduct(high - low)).squaredNorm();
      if (!(square > 0)) break;
      at += (kMinDistance - here) / square * slope.cwiseProduct((high - low).cwiseAbs2());
      at = at.cwiseMax(cell.low).cwiseMin(cell.high);
    }
    return at;
  }

  double signedDistance(int border, const Eigen::Vector3d& x) const {
    return surface_.cutBorders()[border].level(x) / surface_.cutBorders()[border].width;
  }

  const SplineSurface& surface_;
  int owner_;
};

/// Places of the collocation point of a function on the side to which it belongs. `functions`: its
/// occurrences; of those in several patches, the first counts in which the point gets far enough
/// from the border, or farthest. Beyond a sharp edge none counts.
std::vector<ElementPlace> placesBesideBorder(const SplineSurface& surface, int coefficient,
                                             std::vector<ElementPlace> greville,
                                             const std::vector<SplineOccurrence>& functions) {
  if (surface.owners()[coefficient] == SplineSurface::kFixedPatch) return greville;
  const BorderDistance distance(surface, coefficient);
  const auto isOwn = [&](const ElementPlace& place) {
    return carries(surface, place.element, coefficient);
  };
  if (distance.at(surface.evaluate(greville.front()).position) >= kMinDistance &&
      std::all_of(greville.begin(), greville.end(), isOwn))
    return greville;
  const auto groupOf = [&](const SplineOccurrence& function) {
    return surface.patches()[function.patch].smoothingGroup;
  };
  std::vector<ElementPlace> places;
  double farthest = -std::numeric_limits<double>::infinity();
  for (const SplineOccurrence& function : functions) {
    if (groupOf(function) != groupOf(functions.front()) || farthest >= kEnough) continue;
    const Eigen::Vector2d from =
        surface.parameters(grevillePlaces(surface, function).front()).parameters;
    const Eigen::Vector2d at = distance.moved(function.patch, from, Cell(surface, function));
    const double here = distance.inPatch(function.patch, at);
    if (here <= farthest) continue;
    farthest = here;
    places = placesInPatch(surface, function.patch, at[0], at[1]);
  }
  std::erase_if(places, [&](const ElementPlace& place) { return !isOwn(place); });
  if (places.empty()) places = placesOnOwnSide(surface, coefficient);
  std::erase_if(places, [&](const ElementPlace& place) { return !isOwn(place); });
  const ElementPlace& first = places.front();
  return surfacePlaces(surface, {first.element, surface.parameters(first).parameters}).places;
}

}  // namespace

std::vector<CollocationPlace> grevilleCollocation(const SplineSurface& surface) {
  std::vector<CollocationPlace> points;
  const auto all = occurrences(surface);
  for (int k = 0; k < surface.coefficientCount(); ++k) {
    CollocationPlace point;
    for (const SplineOccurrence& at : all[k])
      for (const ElementPlace& place : grevillePlaces(surface, at)) point.places.push_back(place);
    if (surface.isTorn(k) &&
        !std::all_of(point.places.begin(), point.places.end(),
                     [&](const ElementPlace& p) { return carries(surface, p.element, k); }))
      point.places = placesOnOwnSide(surface, k);
    if (!surface.owners().empty() && !point.places.empty())
      point.places = placesBesideBorder(surface, k, std::move(point.places), all[k]);
    if (point.places.empty())
      throw std::invalid_argument("grevilleCollocation: a control point belongs to no patch");
    point.position = surface.evaluate(point.places.front()).position;
    points.push_back(std::move(point));
  }
  return points;
}

std::optional<CollocationPlace> shiftedCollocation(const SplineSurface& surface,
                                                   const SplineTractions& tractions, int slot,
                                                   double shift) {
  const auto& wanted = tractions.slots.slots[slot];
  const auto all = occurrences(surface);
  for (const SplineOccurrence& at : all[wanted.node])
    for (const ElementPlace& place : grevillePlaces(surface, at)) {
      const SplineElement& element = surface.elements()[place.element];
      if (surface.smoothingGroup(place.element) != wanted.smoothingGroup ||
          element.tag != wanted.tag)
        continue;
      const auto& basis = surface.patches()[element.patch].basis;
      Eigen::Vector2d parameter = surface.parameters(place).parameters;
      const std::array<int, 2> function{at.i, at.j};
      for (int d = 0; d < 2; ++d) {
        const auto& own = basis[d].spans()[element.span[d]];
        const double middle = (own.lower + own.upper) / 2, size = own.upper - own.lower;
        if (std::abs(std::abs(parameter[d] - middle) - size / 2) > 1e-9 * size) continue;
        // Shift only away from borders at which the part ends.
        std::array<int, 2> span = element.span;
        const int step = parameter[d] < middle ? -1 : 1;
        span[d] += step;
        const bool isPatchEnd = span[d] < 0 || span[d] >= static_cast<int>(basis[d].spans().size());
        if (!isPatchEnd &&
            surface.elements()[surface.elementsAt(element.patch, span[0], span[1]).front()].tag ==
                wanted.tag)
          continue;
        const int next = std::clamp(function[d] - step, 0, basis[d].count() - 1);
        parameter[d] += shift * (basis[d].greville(next) - parameter[d]);
      }
      CollocationPlace point;
      point.places = placesInPatch(surface, element.patch, parameter[0], parameter[1]);
      if (point.places.empty() ||
          surface.elements()[point.places.front().element].tag != wanted.tag)
        continue;
      point.position = surface.evaluate(point.places.front()).position;
      return point;
    }
  return {};
}

}  // namespace palpa::bem
