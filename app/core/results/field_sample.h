#pragma once

#include <string>

#include "app/core/model/touch_model.h"
#include "bem/model/surface_point.h"

namespace palpa::app {

/// What a field is at one place of the surface.
struct FieldSample {
  Eigen::Vector3d at;              ///< the place asked about, mm
  Eigen::Vector3d nearestSurface;  ///< mm
  Eigen::Vector3d displacement;    ///< mm
  Eigen::Vector3d traction;        ///< MPa, on the face the nearest point lies in
};

/// Reads a state off at the surface point nearest to `at`. Throws SolverError (kBadCondition) when
/// that is farther than checkNearSurface allows.
FieldSample sampleField(const TouchModel& model, const TouchState& state,
                        const Eigen::Vector3d& at);

/// Throws SolverError (kBadCondition), beginning with `what`, when the point is farther from the
/// surface than 2 % of the body's size or one mean edge length: it was probably not meant.
void checkNearSurface(const bem::BoundaryMesh& mesh, const Eigen::Vector3d& point,
                      const std::string& what);

}  // namespace palpa::app
