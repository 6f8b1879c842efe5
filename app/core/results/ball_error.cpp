#include "app/core/results/ball_error.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bem/model/surface_point.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;

/// Mean curvature of the surface around a contact, 1/mm, from its height at a distance of `reach`;
/// positive where the surface is convex.
double meanCurvature(const bem::BoundaryMesh& mesh, const PressingBall& ball, double reach) {
  const Vector3d along = ball.normal.unitOrthogonal(), across = ball.normal.cross(along);
  double sum = 0;
  for (const Vector3d& direction : std::array<Vector3d, 4>{along, -along, across, -across}) {
    const Vector3d from =
        bem::nearestSurfacePoint(mesh, ball.at + reach * direction).position - ball.at;
    const double depth = -from.dot(ball.normal);
    const double aside = (from + depth * ball.normal).squaredNorm();
    if (aside > 0) sum += 2 * depth / aside;
  }
  return sum / 4;
}

}  // namespace

double ballPressureError(const BoundarySetup& setup, const PressingBall& ball) {
  constexpr double kOfSplines = 0.15, kOfTriangles = 0.06, kMaskCompliance = 0.7665;
  const bem::Material& material = setup.material;
  const double modulus =
      material.youngsModulus / (1 - material.poissonRatio * material.poissonRatio);
  const double curvature =
      std::max(1 / ball.radius + meanCurvature(setup.mesh(), ball, ball.maskRadius), 1e-9);
  const double area = std::cbrt(3 * ball.force / (4 * modulus * curvature));
  const double ofContact = kMaskCompliance * ball.force / (modulus * ball.maskRadius);
  return (setup.splines ? kOfSplines : kOfTriangles) * std::min(1.0, ball.maskRadius / area) *
         std::cbrt(std::min(1.0, ofContact / ball.deflection));
}

double ballPressureError(const BoundarySetup& setup, const TouchState::Contact& contact) {
  if (!contact.isBall() || contact.patch.empty() || contact.force.isZero(0)) return 0;
  double maskRadius = 0;
  for (const auto& mask : contact.patch) maskRadius = std::max(maskRadius, mask.radius);
  return ballPressureError(setup, {contact.at, contact.normal, contact.radius, maskRadius,
                                   contact.force.norm(), contact.deflection.norm()});
}

}  // namespace palpa::app
