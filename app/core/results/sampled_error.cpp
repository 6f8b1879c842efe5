#include "app/core/results/sampled_error.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "bem/spline/spline_discretisation.h"

namespace palpa::app {

using Eigen::Vector3d;

namespace {

/// Displacements below this part of the body's size count as zero.
constexpr double kStill = 1e-9;

/// True if the border of a support runs through patches of splines, whose elements then do not
/// follow the field there.
bool hasCutSplines(const BoundarySetup& setup) {
  if (!setup.splines) return false;
  const bem::SplineSurface& surface = setup.splines->surface();
  for (int e = 0; e < surface.elementCount(); ++e)
    if (surface.isCut(e)) return true;
  return false;
}

}  // namespace

CoverFactors coverFactors(const BoundarySetup& setup) {
  if (setup.engine == modeling::Engine::kTriangles) return {4.5, 4.5};
  if (setup.engine == modeling::Engine::kQuadratic) return {5, 0.8};
  return {hasCutSplines(setup) ? 2.8 : 1.5, 2.4};
}

Vector3d SampledError::vectorAt(const bem::SurfacePoint& place) const {
  const bem::Discretisation& on = *setup_.discretisation;
  return on.interpolate(place, carried_) + on.displacementDefect(place, u_, p_, bulk_);
}

SampledError::Squares SampledError::at(const bem::SurfacePoint& place) const {
  return {vectorAt(place).squaredNorm(),
          setup_.discretisation->interpolate(place, u_).squaredNorm()};
}

std::vector<SampledError::Squares> errorsAt(const std::vector<bem::SurfacePoint>& places,
                                            const SampledError& error, const Job& job) {
  std::vector<SampledError::Squares> errors(places.size());
  parallelFor(static_cast<std::ptrdiff_t>(places.size()), job, [&](std::ptrdiff_t k) {
    errors[static_cast<std::size_t>(k)] = error.at(places[static_cast<std::size_t>(k)]);
  });
  return errors;
}

bem::BoundaryField carriedError(const TouchModel& model, const bem::Bulk& bulk,
                                const bem::BoundaryField& fields, const Job& job) {
  return model.setup().discretisation->estimatedError(*model.problem(), fields, bulk, job);
}

std::vector<bem::SurfacePoint> spread(const bem::BoundaryMesh& mesh,
                                      const std::vector<int>& triangles, int samples) {
  const Vector3d middle = Vector3d::Constant(1.0 / 3);
  const std::size_t step = std::max<std::size_t>(1, triangles.size() / std::max(samples, 1));
  std::vector<bem::SurfacePoint> places;
  for (std::size_t k = step / 2; k < triangles.size(); k += step)
    places.push_back({triangles[k], middle, mesh.point(triangles[k], middle), 0.0});
  return places;
}

double reachOf(const TouchState::Contact& contact) {
  return contact.isBall() ? contact.patchRadius() : contact.radius;
}

double errorAtContact(const bem::BoundaryMesh& mesh, const SampledError& error,
                      const TouchState::Contact& contact) {
  if (!(contact.displacement.norm() > kStill * mesh.boundingSize())) return 0;
  const double reach = reachOf(contact);
  const Vector3d along = contact.normal.unitOrthogonal(), across = contact.normal.cross(along);
  const Eigen::Matrix3d stiffness =
      contact.compliance ? contact.compliance->inverse().eval() : Eigen::Matrix3d::Zero();
  double ofDisplacement = 0, ofForce = 0;
  for (const Vector3d& direction :
       std::array<Vector3d, 5>{Vector3d::Zero(), along, -along, across, -across}) {
    const Vector3d here =
        error.vectorAt(bem::nearestSurfacePoint(mesh, contact.at + 0.5 * reach * direction));
    ofDisplacement += here.squaredNorm() / 5;
    ofForce += (stiffness * here).squaredNorm() / 5;
  }
  const double relative = std::sqrt(ofDisplacement) / contact.displacement.norm();
  if (!contact.compliance) return relative;
  const double force = std::max((stiffness * contact.displacement).norm(), contact.force.norm());
  return std::max(relative, std::sqrt(ofForce) / force);
}

}  // namespace palpa::app
