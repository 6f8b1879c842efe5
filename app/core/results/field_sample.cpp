#include "app/core/results/field_sample.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bem/base/error.h"

namespace palpa::app {

void checkNearSurface(const bem::BoundaryMesh& mesh, const Eigen::Vector3d& point,
                      const std::string& what) {
  const bem::SurfacePoint nearest = bem::nearestSurfacePoint(mesh, point);
  const double allowed = std::max(0.02 * mesh.boundingSize(), mesh.meanEdgeLength());
  if (nearest.distance <= allowed) return;
  // Without this, a rounded zero would read as 1.85e-16.
  const auto shown = [&](double coordinate) {
    return std::abs(coordinate) < 1e-9 * mesh.boundingSize() ? 0.0 : coordinate;
  };
  char text[256];
  std::snprintf(text, sizeof text,
                " at (%.6g, %.6g, %.6g) mm is %.4g mm away from the surface; the nearest surface "
                "point is (%.6g, %.6g, %.6g) mm",
                point[0], point[1], point[2], nearest.distance, shown(nearest.position[0]),
                shown(nearest.position[1]), shown(nearest.position[2]));
  throw bem::SolverError(bem::SolverError::Kind::kBadCondition, what + text);
}

namespace {

/// True if a fixed support prescribes the displacement of a place.
bool isFixed(const BoundarySetup& setup, const bem::SurfacePoint& place) {
  for (const auto& support : setup.supports) {
    if (support.isFixed &&
        std::binary_search(support.triangles.begin(), support.triangles.end(), place.triangle))
      return true;
  }
  return false;
}

}  // namespace

FieldSample sampleField(const TouchModel& model, const TouchState& state,
                        const Eigen::Vector3d& at) {
  const BoundarySetup& setup = model.setup();
  checkNearSurface(setup.mesh(), at, "the sample");
  const bem::SurfacePoint nearest = bem::nearestSurfacePoint(setup.mesh(), at);
  const Eigen::VectorXd u = state.field.u.col(0), p = state.field.p.col(0);
  const bem::Discretisation& on = *setup.discretisation;
  // A prescribed displacement is known exactly.
  const Eigen::Vector3d displacement = isFixed(setup, nearest)
                                           ? on.interpolate(nearest, u)
                                           : on.displacementAt(nearest, u, p, setup.bulk());
  return {at, nearest.position, displacement, on.tractionAt(nearest, p)};
}

}  // namespace palpa::app
