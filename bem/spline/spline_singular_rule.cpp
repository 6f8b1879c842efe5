#include "bem/spline/spline_singular_rule.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "bem/spline/gauss_rule.h"

namespace palpa::bem {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// Number of Gauss points on an interval for a function whose nearest poles lie at `center` ± i
/// pi/2: the error is proportional to rho^-2n with rho of the Bernstein ellipse through the poles.
int pointsForPoles(double first, double last, double error) {
  const double half = (last - first) / 2;
  const std::complex<double> pole(-(first + last) / 2 / half, std::numbers::pi / 2 / half);
  const std::complex<double> root = std::sqrt(pole * pole - 1.0);
  const double rho = std::max(std::abs(pole + root), std::abs(pole - root));
  return std::clamp(static_cast<int>(std::ceil(-std::log(error) / (2 * std::log(rho)))) + 1, 3,
                    kMaxGaussPoints);
}

}  // namespace

bool isFoldedCorner(const SplineSurface& surface, const SplineCell& cell,
                    const SplinePlace& place) {
  const std::array<double, 2> parameter{place.u, place.v};
  for (int d = 0; d < 2; ++d) {
    const double size = cell.upper[d] - cell.lower[d];
    if (std::min(parameter[d] - cell.lower[d], cell.upper[d] - parameter[d]) > 1e-9 * size)
      return false;
  }
  const SplineJet jet = surface.evaluate(place);
  return jet.du.norm() > 0 && jet.dv.norm() > 0 &&
         jet.areaVector().norm() < 0.05 * jet.du.norm() * jet.dv.norm();
}

void addFoldedCorner(const SplineSurface& surface, const SplineCell& cell, const SplinePlace& place,
                     const SingularAccuracy& accuracy, SplineRule& rule) {
  // Both derivatives lie on one line and point apart (the corner of a round cap on its rim). So a
  // ray from the corner into the cell exists along which the distance of the surface from the
  // corner grows only quadratically. In parameters, the angles are concentrated around this ray,
  // the more the nearer the corner.
  const SplineJet jet = surface.evaluate(place);
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
      return SplinePlace{place.element, place.u + offset[0], place.v + offset[1]};
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
        const SplinePlace point = at(s, flat + height * std::sinh(w));
        rule.add(point.u, point.v,
                 std::abs(size[0] * size[1]) * s * radial.weights[m] * angular.weights[k] *
                     (to - from) * height * std::cosh(w));
      }
    }
  }
}

void addPolar(const SplineSurface& surface, const SplineCell& cell, const SplinePlace& place,
              const SingularAccuracy& accuracy, SplineRule& rule) {
  const auto [position, du, dv] = surface.evaluate(place);
  const Vector3d axis = du.normalized();
  const Vector3d across = (dv - dv.dot(axis) * axis).normalized();
  const Vector2d columnU(du.dot(axis), 0), columnV(dv.dot(axis), dv.dot(across));

  const Vector2d center(place.u, place.v);
  const std::array<Vector2d, 4> corner{
      Vector2d(cell.lower[0], cell.lower[1]), Vector2d(cell.upper[0], cell.lower[1]),
      Vector2d(cell.upper[0], cell.upper[1]), Vector2d(cell.lower[0], cell.upper[1])};
  const double cellArea = (cell.upper[0] - cell.lower[0]) * (cell.upper[1] - cell.lower[1]);
  for (int side = 0; side < 4; ++side) {
    const Vector2d a = corner[side] - center, b = corner[(side + 1) % 4] - center;
    const double area = a[0] * b[1] - a[1] * b[0];  // twice the area of the triangle
    if (area < 1e-9 * cellArea) continue;
    const auto image = [&](const Vector2d& p) { return Vector2d(columnU * p[0] + columnV * p[1]); };
    const Vector2d from = image(a), edge = image(b) - from;
    const double length = edge.norm();
    const double start = from.dot(edge) / length, end = start + length;
    const double height = std::abs(from[0] * edge[1] - from[1] * edge[0]) / length;
    // Along the side at distance `height`, t = height sinh w: distances are height cosh w, so no
    // integrand has poles nearer than ± i pi/2.
    const double first = std::asinh(start / height), last = std::asinh(end / height);
    const int count = pointsForPoles(first, last, accuracy.error);
    const GaussRule &angular = gaussRule(count), &radial = gaussRule(accuracy.radial);
    for (int k = 0; k < count; ++k) {
      const double w = first + angular.points[k] * (last - first);
      const double along = (height * std::sinh(w) - start) / length;
      const double weight =
          area * angular.weights[k] * (last - first) * height * std::cosh(w) / length;
      const Vector2d reach = a + along * (b - a);
      for (int m = 0; m < accuracy.radial; ++m) {
        const double s = radial.points[m];
        rule.add(place.u + s * reach[0], place.v + s * reach[1], weight * s * radial.weights[m]);
      }
    }
  }
}

}  // namespace palpa::bem
