#include "bem/element/element_quadrature.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace palpa::bem {

const ElementPlace* placeIn(const CollocationPlace& point, int element) {
  const auto found =
      std::find_if(point.places.begin(), point.places.end(),
                   [element](const ElementPlace& place) { return place.element == element; });
  return found == point.places.end() ? nullptr : &*found;
}

ElementFoot nearestOnSurface(const ElementSurface& surface, const ElementQuadrature& quadrature,
                             const Eigen::Vector3d& x) {
  constexpr std::size_t kMaxTrials = 16;
  std::vector<double> bound(static_cast<std::size_t>(surface.elementCount()));
  for (int e = 0; e < surface.elementCount(); ++e) bound[e] = quadrature.distance(e, x);
  std::vector<int> order(bound.size());
  std::iota(order.begin(), order.end(), 0);
  const auto tried =
      order.begin() + static_cast<std::ptrdiff_t>(std::min(order.size(), kMaxTrials));
  std::partial_sort(order.begin(), tried, order.end(),
                    [&](int a, int b) { return bound[a] < bound[b]; });
  ElementFoot best{{-1, 0, 0}, std::numeric_limits<double>::infinity()};
  for (auto e = order.begin(); e != tried && bound[*e] < best.distance; ++e) {
    const ElementFoot foot = surface.nearestOnElement(*e, x);
    if (foot.distance < best.distance) best = foot;
  }
  return best;
}

}  // namespace palpa::bem
