#pragma once

#include <string>

#include "app/core/model/touch_model.h"
#include "bem/model/surface_point.h"

namespace palpa::app {

/// Values of a field at one place of the surface.
struct FieldSample {
  Eigen::Vector3d at;              ///< the requested place, mm
  Eigen::Vector3d nearestSurface;  ///< mm
  Eigen::Vector3d displacement;    ///< mm
  Eigen::Vector3d traction;        ///< MPa, on the face of the nearest point
};

/// Samples a state at the surface point nearest to `at`. Throws SolverError (kBadCondition) if that
/// point is farther than checkNearSurface() allows.
FieldSample sampleField(const TouchModel& model, const TouchState& state,
                        const Eigen::Vector3d& at);

/// Throws SolverError (kBadCondition), with a message that begins with `what`, if the point is
/// farther from the surface than 2 % of the body's size or one mean edge length: probably a
/// mistake.
void checkNearSurface(const bem::BoundaryMesh& mesh, const Eigen::Vector3d& point,
                      const std::string& what);

}  // namespace palpa::app
