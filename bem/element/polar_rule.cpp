#include "bem/element/polar_rule.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "bem/base/gauss_rule.h"

namespace palpa::bem {

using Eigen::Vector2d;
using Eigen::Vector3d;

SingularAccuracy::SingularAccuracy(double tolerance)
    : error(std::clamp(tolerance, 1e-12, 1e-2)),
      radial(std::max(3, static_cast<int>(std::lround(-std::log10(error))))) {}

int pointsForPoles(double first, double last, double error) {
  // The error is proportional to rho^-2n with rho of the Bernstein ellipse through the poles.
  const double half = (last - first) / 2;
  const std::complex<double> pole(-(first + last) / 2 / half, std::numbers::pi / 2 / half);
  const std::complex<double> root = std::sqrt(pole * pole - 1.0);
  const double rho = std::max(std::abs(pole + root), std::abs(pole - root));
  return std::clamp(static_cast<int>(std::ceil(-std::log(error) / (2 * std::log(rho)))) + 1, 3,
                    kMaxGaussPoints);
}

void addPolar(const SurfaceJet& jet, const Vector2d& center, std::span<const Vector2d> corners,
              const SingularAccuracy& accuracy, ElementRule& rule) {
  const Vector3d axis = jet.du.normalized();
  const Vector3d across = (jet.dv - jet.dv.dot(axis) * axis).normalized();
  const Vector2d columnU(jet.du.dot(axis), 0), columnV(jet.dv.dot(axis), jet.dv.dot(across));
  const auto cross = [](const Vector2d& a, const Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; };
  double cellArea = 0;  // twice the area
  for (std::size_t k = 0; k < corners.size(); ++k)
    cellArea += cross(corners[k] - corners[0], corners[(k + 1) % corners.size()] - corners[0]);
  for (std::size_t side = 0; side < corners.size(); ++side) {
    const Vector2d a = corners[side] - center, b = corners[(side + 1) % corners.size()] - center;
    const double area = cross(a, b);  // twice the area of the triangle
    if (area < 0.5e-9 * cellArea) continue;
    const auto image = [&](const Vector2d& p) { return Vector2d(columnU * p[0] + columnV * p[1]); };
    const Vector2d from = image(a), edge = image(b) - from;
    const double length = edge.norm();
    const double start = from.dot(edge) / length, end = start + length;
    const double height = std::abs(cross(from, edge)) / length;
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
        rule.add(center[0] + s * reach[0], center[1] + s * reach[1],
                 weight * s * radial.weights[m]);
      }
    }
  }
}

}  // namespace palpa::bem
