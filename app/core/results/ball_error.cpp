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

/// True if a part of the surface beyond a sharp edge reaches into the ball of radius `reach` (mm)
/// around a place.
bool isBesideEdge(const bem::BoundaryMesh& mesh, const Vector3d& at, double reach) {
  const auto groupOf = [&mesh](int triangle) {
    return mesh.smoothingGroups[static_cast<std::size_t>(triangle)];
  };
  const int group = groupOf(bem::nearestSurfacePoint(mesh, at).triangle);
  for (int t = 0; t < mesh.triangleCount(); ++t) {
    if (groupOf(t) == group) continue;
    for (const int node : mesh.triangles[static_cast<std::size_t>(t)])
      if ((mesh.nodes[static_cast<std::size_t>(node)] - at).norm() < reach) return true;
  }
  return false;
}

}  // namespace

double ballPressureError(const BoundarySetup& setup, const PressingBall& ball) {
  constexpr double kOfSplines = 0.15, kOfTriangles = 0.06, kMaskCompliance = 0.7665;
  constexpr double kBesideEdge = 3;
  const bem::Material& material = setup.material;
  const double modulus =
      material.youngsModulus / (1 - material.poissonRatio * material.poissonRatio);
  const double curvature =
      std::max(1 / ball.radius + meanCurvature(setup.mesh(), ball, ball.maskRadius), 1e-9);
  const double area = std::cbrt(3 * ball.force / (4 * modulus * curvature));
  const double ofContact = kMaskCompliance * ball.force / (modulus * ball.maskRadius);
  const bool isUneven =
      setup.splines && ball.masks == 1 && isBesideEdge(setup.mesh(), ball.at, ball.maskRadius);
  return (setup.splines ? kOfSplines : kOfTriangles) * (isUneven ? kBesideEdge : 1) *
         std::min(1.0, ball.maskRadius / area) *
         std::cbrt(std::min(1.0, ofContact / ball.deflection));
}

double ballPressureError(const BoundarySetup& setup, const TouchState::Contact& contact) {
  if (!contact.isBall() || contact.patch.empty() || contact.force.isZero(0)) return 0;
  double maskRadius = 0;
  for (const auto& mask : contact.patch) maskRadius = std::max(maskRadius, mask.radius);
  return ballPressureError(
      setup, {contact.at, contact.normal, contact.radius, maskRadius, contact.force.norm(),
              contact.deflection.norm(), contact.patch.size()});
}

}  // namespace palpa::app
