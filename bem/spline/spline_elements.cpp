#include "bem/spline/spline_elements.h"

#include <limits>

#include "bem/spline/spline_nearest.h"
#include "bem/spline/spline_projection.h"
#include "bem/spline/spline_state.h"

namespace palpa::bem {

SurfaceTangents SplineElements::tangents(const ElementPlace& place) const {
  return splineTangents(surface_, {place.element, surface_.parameters(place).parameters});
}

ElementFoot SplineElements::nearestOnElement(int element, const Eigen::Vector3d& x) const {
  return bem::nearestOnElement(surface_, element, x);
}

void SplineElements::samplePlaces(int element, std::vector<WeightedPlace>& places) const {
  // With two points per direction, no point coincides with a collocation point of any degree.
  constexpr int kPoints = 2;
  visitSplinePoints(surface_, {element}, kPoints, std::numeric_limits<double>::infinity(),
                    [&](const ElementPlace& place, const SurfaceJet&, double weight) {
                      places.push_back({place, weight});
                    });
}

}  // namespace palpa::bem
