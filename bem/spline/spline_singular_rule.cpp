#include "bem/spline/spline_singular_rule.h"

#include <algorithm>
#include <cmath>

#include "bem/base/gauss_rule.h"

namespace palpa::bem {

using Eigen::Vector2d;

bool isFoldedCorner(const SplineSurface& surface, const SplineCell& cell,
                    const ElementPlace& place) {
  const std::array<double, 2> parameter{place.u, place.v};
  for (int d = 0; d < 2; ++d) {
    const double size = cell.upper[d] - cell.lower[d];
    if (std::min(parameter[d] - cell.lower[d], cell.upper[d] - parameter[d]) > 1e-9 * size)
      return false;
  }
  const SurfaceJet jet = surface.evaluate(place);
  return jet.du.norm() > 0 && jet.dv.norm() > 0 &&
         jet.areaVector().norm() < 0.05 * jet.du.norm() * jet.dv.norm();
}

void addFoldedCorner(const SplineSurface& surface, const SplineCell& cell,
                     const ElementPlace& place, const SingularAccuracy& accuracy,
                     ElementRule& rule) {
  // Both derivatives lie on one line and point apart (the corner of a round cap on its rim). So a
  // ray from the corner into the cell exists along which the distance of the surface from the
  // corner grows only quadratically. In parameters, the angles are concentrated around this ray,
  // the more the nearer the corner.
  const SurfaceJet jet = surface.evaluate(place);
  const std::array<double, 2> size{
      place.u - cell.lower[0] < cell.upper[0] - place.u ? cell.upper[0] - cell.lower[0]
                                                        : cell.lower[0] - cell.upper[0],
      place.v - cell.lower[1] < cell.upper[1] - place.v ? cell.upper[1] - cell.lower[1]
                                                        : cell.lower[1] - cell.upper[1]};
  const std::array<double, 2> length{jet.du.norm() * std::abs(size[0]),
                                     jet.dv.norm() * std::abs(size[1])};
  const GaussRule& radial = gaussRule(accuracy.radial);
  for (int first = 0; first < 2; ++first) {  // the triangles on both sides of the diagonal
    const int second = 1 - first;
    const double flat = length[first] / length[second];
    const auto at = [&](double s, double t) {
      std::array<double, 2> offset{};
      offset[first] = s * size[first];
      offset[second] = s * t * size[second];
      return ElementPlace{place.element, place.u + offset[0], place.v + offset[1]};
    };
    for (std::size_t m = 0; m < radial.points.size(); ++m) {
      const double s = radial.points[m];
      const double along = (surface.evaluate(at(s, flat)).position - jet.position).norm();
      const double height = std::max(along / (s * length[second]), 1e-6);
      const double from = std::asinh(-flat / height), to = std::asinh((1 - flat) / height);
      const int count = pointsForPoles(from, to, accuracy.error);
      const GaussRule& angular = gaussRule(count);
      for (int k = 0; k < count; ++k) {
        const double w = from + angular.points[k] * (to - from);
        const ElementPlace point = at(s, flat + height * std::sinh(w));
        rule.add(point.u, point.v,
                 std::abs(size[0] * size[1]) * s * radial.weights[m] * angular.weights[k] *
                     (to - from) * height * std::cosh(w));
      }
    }
  }
}

void addPolar(const SplineSurface& surface, const SplineCell& cell, const ElementPlace& place,
              const SingularAccuracy& accuracy, ElementRule& rule) {
  const std::array<Vector2d, 4> corners{
      Vector2d(cell.lower[0], cell.lower[1]), Vector2d(cell.upper[0], cell.lower[1]),
      Vector2d(cell.upper[0], cell.upper[1]), Vector2d(cell.lower[0], cell.upper[1])};
  addPolar(surface.evaluate(place), {place.u, place.v}, corners, accuracy, rule);
}

}  // namespace palpa::bem
