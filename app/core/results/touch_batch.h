#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "app/core/live/touchable_model.h"
#include "base/job.h"

namespace palpa::app {

/// Results of touches that act one at a time. One column, or one entry, per touch.
struct TouchBatch {
  using Status = bem::ContactSimulation::Status;
  /// mm, nearest points of the unloaded surface; of pushes and balls where they have slid to.
  Eigen::Matrix3Xd places;
  Eigen::Matrix3Xd normals;        ///< outward, unit, there
  Eigen::Matrix3Xd forces;         ///< N, on the body
  Eigen::Matrix3Xd displacements;  ///< mm, of the place, from all causes
  Eigen::Matrix3Xd deflections;    ///< mm, see TouchState::Contact
  Eigen::VectorXd stiffness;       ///< |force| / |deflection|, N/mm; 0 without force
  std::vector<Status> statuses;
  /// Forces of the masks that each touch consists of, for SurfaceSensor.
  std::vector<std::vector<bem::ContactSimulation::PatchForce>> patches;

  std::size_t size() const { return statuses.size(); }
};

/// Touches a body many times, each touch alone, as playTouches() does with one touch. Grabs, forces
/// and pins take the single precision Green's columns instead of a solution with refinement: forces
/// differ by about 1e-5 of their size, and each costs tens of microseconds. Pushes and balls follow
/// their trajectories, as in playTouches(): some milliseconds each. Columns that are missing are
/// computed before, all of them if the batch has many touches.
///
/// The results do not depend on the number of threads or on the other touches. Phases of progress:
/// "Green's function", "touch". Throws SolverError as playTouches(), with the number of the touch
/// (from 0) in the message; Cancelled.
TouchBatch touchOneByOne(const TouchableModel& model, std::span<const modeling::Touch> touches,
                         int steps = 0, const Job& job = {});

}  // namespace palpa::app
