#include "app/core/probe.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bem/error.h"
#include "bem/results.h"

namespace palpa::app {

void checkNearSurface(const bem::BoundaryMesh& mesh, const Eigen::Vector3d& point,
                      const std::string& what) {
  const bem::SurfacePoint nearest = bem::nearestSurfacePoint(mesh, point);
  const double allowed = std::max(0.02 * mesh.boundingSize(), mesh.meanEdgeLength());
  if (nearest.distance <= allowed) return;
  // Rounding of zero would read as 1.85e-16.
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

Probe probe(const TouchModel& model, const TouchState& state, const Eigen::Vector3d& at) {
  const BoundarySetup& setup = model.setup();
  checkNearSurface(setup.mesh, at, "the probe");
  const bem::SurfacePoint nearest = bem::nearestSurfacePoint(setup.mesh, at);
  const Eigen::VectorXd u = state.field.u.col(0), p = state.field.p.col(0);
  Probe result{at, nearest.position, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  bool held = true;
  for (int corner = 0; corner < 3; ++corner) {
    const int node = setup.mesh.triangles[nearest.triangle][corner];
    const int slot = setup.slots.ofCorner[nearest.triangle][corner];
    held = held && setup.conditions.ofSlot[slot] == bem::SlotCondition::kFixed;
    result.displacement += nearest.weights[corner] * u.segment<3>(3 * node);
    result.traction += nearest.weights[corner] * p.segment<3>(3 * slot);
  }
  // Where a support prescribes the displacement it is known exactly.
  if (!held)
    result.displacement =
        bem::surfaceDisplacement(setup.mesh, setup.slots, u, p, setup.material, nearest);
  return result;
}

}  // namespace palpa::app
