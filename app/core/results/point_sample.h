#pragma once

#include <optional>
#include <vector>

#include "app/core/model/touch_model.h"
#include "app/core/results/stress_numbers.h"
#include "bem/model/surface_point.h"

namespace palpa::app {

/// All fields at one point of a body.
struct PointSample {
  Eigen::Vector3d at;                       ///< mm, at rest
  Eigen::Vector3d displacement;             ///< mm
  std::optional<Eigen::Vector3d> traction;  ///< MPa; only on the surface
  Eigen::Matrix3d stress;                   ///< MPa, global axes
  Eigen::Matrix3d strain;                   ///< linear, global axes
  StressNumbers numbers;                    ///< of the stress
};

/// Sample at a surface point, from the values that colours show. `slotStress`: from
/// bem::Discretisation::surfaceStress() of the field.
PointSample sampleSurface(const TouchModel& model, const bem::BoundaryField& field,
                          const std::vector<Eigen::Matrix3d>& slotStress,
                          const bem::SurfacePoint& place);

/// Sample at a point inside the body (mm, at rest) from its state.
PointSample sampleInside(const TouchModel& model, const Eigen::Vector3d& at,
                         const bem::InteriorState& state);

}  // namespace palpa::app
