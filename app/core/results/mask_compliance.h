#pragma once

#include <Eigen/Dense>
#include <span>

#include "app/core/live/touchable_model.h"
#include "base/job.h"
#include "bem/contact/contact_mask.h"
#include "bem/model/boundary_conditions.h"

namespace palpa::app {

/// Compliance between places of a body: block (i, j), 3 x 3, is the mean displacement (mm) of the
/// mask at place i per unit force (N) on the mask at place j. Symmetric. A dense block of the
/// Green's function, averaged over masks of `radius` (mm). Solved with refinement, as playTouches()
/// does: touches that grab the places answer with f = C^-1 (d - d0), where d0 is the displacement
/// under loads alone.
///
/// Costs a solution with three right-hand sides per place and 72 bytes per pair of places. Phase of
/// progress: "solve". Throws SolverError (kBadCondition) for a place far from the surface or on a
/// support, kTooLarge above kMaxCompliancePlaces; Cancelled.
Eigen::MatrixXd maskCompliance(const TouchableModel& model, std::span<const Eigen::Vector3d> places,
                               double radius, const Job& job = {});

/// Displacement and traction coefficients for unit forces along x, y, z on each of some masks:
/// three columns for each, solved with refinement. Throws Cancelled.
bem::BoundaryField unitFields(const TouchableModel& model, std::span<const bem::ContactMask> masks,
                              const Job& job);

inline constexpr std::size_t kMaxCompliancePlaces = 5000;

}  // namespace palpa::app
