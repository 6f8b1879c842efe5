#include "bem/spline/spline_collocation.h"

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>

#include "bem/base/gauss_rule.h"

namespace palpa::bem {
namespace {

bool carries(const SplineSurface& surface, int element, int coefficient) {
  const std::vector<int>& list = surface.functions(element);
  return std::find(list.begin(), list.end(), coefficient) != list.end();
}

/// Places for a torn function whose Greville point lies on the other side of the border: the mean
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
        surface.evaluateBasis(place, basis);
        double value = 0;
        for (std::size_t f = 0; f < basis.size(); ++f)
          if (surface.functions(e)[f] == coefficient) value += basis[f];
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
