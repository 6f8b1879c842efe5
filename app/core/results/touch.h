#pragma once

#include <memory>
#include <span>

#include "app/core/model/touch_model.h"
#include "base/job.h"

namespace palpa::app {

/// Radius of a touch that does not name one, mm: that for the mesh's size.
double defaultTouchRadius(const bem::BoundaryMesh& mesh);

/// Plays touches, all at the same time, on a model. Grabs, forces and pins are exact; pushes and
/// probes come after them and go their ways in steps (tool_path.h), `steps` = 0 chooses how many.
/// The field is exact for the forces of the tools.
///
/// Throws SolverError: kBadCondition for a touch on a support, two at one place, one far from the
/// surface, or too many tools; kNotConverged when tools find no equilibrium; Cancelled.
TouchState playTouches(const TouchModel& model, std::span<const modeling::Touch> touches,
                       int steps = 0, const Job& job = {});

/// The seed's nodal switching: gives one free node a displacement (mm). Throws SolverError for a
/// held node or a number out of range.
TouchState touchNode(const TouchModel& model, int node, const Eigen::Vector3d& displacement);

}  // namespace palpa::app
