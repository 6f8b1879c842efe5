#pragma once

#include <memory>
#include <span>

#include "app/core/model/touch_model.h"
#include "base/job.h"
#include "bem/problem/greens_columns.h"

namespace palpa::app {

/// Radius of a touch that does not name one, mm.
double defaultTouchRadius(const bem::BoundaryMesh& mesh);

/// Plays touches on a model and keeps the columns that later plays need, too.
class TouchPlayer {
 public:
  /// `model` must outlive it.
  explicit TouchPlayer(const TouchModel& model);
  ~TouchPlayer();

  /// Plays touches, all at the same time. Grabs, forces and pins are exact; then pushes and balls
  /// follow their trajectories in steps (tool_trajectory.h); `steps` = 0 chooses the number. The
  /// field is exact for the forces of the tools. The state does not depend on earlier plays.
  ///
  /// Throws SolverError: kBadCondition for a touch on a support, two touches at one place, a touch
  /// far from the surface, or too many tools; kNotConverged if tools find no equilibrium;
  /// Cancelled.
  TouchState play(std::span<const modeling::Touch> touches, int steps = 0, const Job& job = {});

 private:
  const TouchModel& model_;
  std::unique_ptr<bem::ContactSurface> surface_;
  std::shared_ptr<bem::GreensColumns> columns_;  // for tools
};

/// TouchPlayer::play() once.
TouchState playTouches(const TouchModel& model, std::span<const modeling::Touch> touches,
                       int steps = 0, const Job& job = {});

/// Displaces one free node (mm) by nodal switching (bem/contact/nodal_switching.h). Throws
/// SolverError for a node on a support or a number out of range.
TouchState touchNode(const TouchModel& model, int node, const Eigen::Vector3d& displacement);

}  // namespace palpa::app
