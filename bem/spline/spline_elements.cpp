#include "bem/spline/spline_elements.h"

#include <limits>

#include "bem/element/gather.h"
#include "bem/spline/spline_nearest.h"
#include "bem/spline/spline_projection.h"
#include "bem/spline/spline_state.h"

namespace palpa::bem {

Eigen::Matrix3Xd SplineElements::displacementsOfTable(int element, const Eigen::VectorXd& u) const {
  const Eigen::Matrix3Xd all = gather(u, surface_.functions(element));
  const BorderFunctions* beside = surface_.borderFunctions(element);
  return beside ? Eigen::Matrix3Xd(all * beside->displacementsOfTable()) : all;
}

Eigen::Matrix3Xd SplineElements::tractionsOfTable(int element, const Eigen::VectorXd& p) const {
  const Eigen::Matrix3Xd all = gather(p, tractions_.ofFunction[element]);
  const BorderFunctions* beside = surface_.borderFunctions(element);
  return beside ? Eigen::Matrix3Xd(all * beside->tractionsOfTable()) : all;
}

void SplineElements::evaluateShares(const ElementPlace& place, std::vector<double>& shares) const {
  if (surface_.borderFunctions(place.element))
    surface_.evaluateShares(place, shares);
  else
    evaluateBasis(place, shares);
}

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
