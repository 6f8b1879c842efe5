#include "bem/spline/spline_collocation.h"

#include <algorithm>
#include <stdexcept>

namespace palpa::bem {
std::vector<SplineCollocationPoint> grevilleCollocation(const SplineSurface& surface) {
  std::vector<SplineCollocationPoint> points;
  for (const auto& list : occurrences(surface)) {
    SplineCollocationPoint point;
    for (const SplineOccurrence& at : list)
      for (const SplinePlace& place : grevillePlaces(surface, at)) point.places.push_back(place);
    if (point.places.empty())
      throw std::invalid_argument("grevilleCollocation: a control point belongs to no patch");
    point.position = surface.evaluate(point.places.front()).position;
    points.push_back(std::move(point));
  }
  return points;
}

SplineCollocationPoint shiftedCollocation(const SplineSurface& surface,
                                          const SplineTractions& tractions, int slot,
                                          double shift) {
  const auto& wanted = tractions.slots.slots[slot];
  const auto all = occurrences(surface);
  for (const SplineOccurrence& at : all[wanted.node])
    for (const SplinePlace& place : grevillePlaces(surface, at)) {
      const SplineElement& element = surface.elements()[place.element];
      if (surface.smoothingGroup(place.element) != wanted.smoothingGroup ||
          element.tag != wanted.tag)
        continue;
      const auto& basis = surface.patches()[element.patch].basis;
      std::array<double, 2> parameter{place.u, place.v};
      const std::array<int, 2> function{at.i, at.j};
      for (int d = 0; d < 2; ++d) {
        const double middle = (element.lower[d] + element.upper[d]) / 2;
        const double size = element.upper[d] - element.lower[d];
        if (std::abs(std::abs(parameter[d] - middle) - size / 2) > 1e-9 * size) continue;
        // Only off borders across which the part ends.
        std::array<int, 2> span = element.span;
        const int step = parameter[d] < middle ? -1 : 1;
        span[d] += step;
        const bool isPatchEnd = span[d] < 0 || span[d] >= static_cast<int>(basis[d].spans().size());
        if (!isPatchEnd &&
            surface.elements()[surface.elementAt(element.patch, span[0], span[1])].tag ==
                wanted.tag)
          continue;
        const int next = std::clamp(function[d] - step, 0, basis[d].count() - 1);
        parameter[d] += shift * (basis[d].greville(next) - parameter[d]);
      }
      SplineCollocationPoint point;
      point.places = placesInPatch(surface, element.patch, parameter[0], parameter[1]);
      point.position = surface.evaluate(point.places.front()).position;
      return point;
    }
  throw std::invalid_argument("shiftedCollocation: the Greville point lies outside of the slot");
}

}  // namespace palpa::bem
