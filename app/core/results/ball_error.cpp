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
double meanCurvature(const bem::BoundaryMesh& mesh, const TouchState::Contact& contact,
                     double reach) {
  const Vector3d along = contact.normal.unitOrthogonal(), across = contact.normal.cross(along);
  double sum = 0;
  for (const Vector3d& direction : std::array<Vector3d, 4>{along, -along, across, -across}) {
    const Vector3d from =
        bem::nearestSurfacePoint(mesh, contact.at + reach * direction).position - contact.at;
    const double depth = -from.dot(contact.normal);
    const double aside = (from + depth * contact.normal).squaredNorm();
    if (aside > 0) sum += 2 * depth / aside;
  }
  return sum / 4;
}

}  // namespace

double ballPressureError(const BoundarySetup& setup, const TouchState::Contact& contact) {
  constexpr double kOfSplines = 0.15, kOfTriangles = 0.1, kMaskCompliance = 0.7665;
  if (!contact.isBall() || contact.patch.empty() || contact.force.isZero(0)) return 0;
  double radius = 0;
  for (const auto& mask : contact.patch) radius = std::max(radius, mask.radius);
  const bem::Material& material = setup.material;
  const double modulus =
      material.youngsModulus / (1 - material.poissonRatio * material.poissonRatio);
  const double curvature =
      std::max(1 / contact.radius + meanCurvature(setup.mesh(), contact, radius), 1e-9);
  const double force = contact.force.norm();
  const double area = std::cbrt(3 * force / (4 * modulus * curvature));
  const double ofContact = kMaskCompliance * force / (modulus * radius);
  return (setup.splines ? kOfSplines : kOfTriangles) * std::min(1.0, radius / area) *
         std::cbrt(std::min(1.0, ofContact / contact.deflection.norm()));
}

}  // namespace palpa::app
