#pragma once
#include <memory>
#include <span>

#include "app/core/touch_model.h"

namespace palpa::app {

/// Radius of a touch that does not name one, mm: that of a fingertip, but at most a fifth of the
/// body's size.
double defaultTouchRadius(const bem::BoundaryMesh& mesh);

/// Plays touches, all at the same time, on a model: masks as wide as their radius, forces or
/// displacements prescribed. Throws SolverError for a touch on a support, two at one place, or one
/// far from the surface.
TouchState playTouches(const TouchModel& model, std::span<const modeling::Touch> touches);

/// The seed's nodal switching: gives one free node a displacement (mm). Throws SolverError for a
/// held node or a number out of range.
TouchState touchNode(const TouchModel& model, int node, const Eigen::Vector3d& displacement);

}  // namespace palpa::app
