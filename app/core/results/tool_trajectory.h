#pragma once

#include <span>
#include <vector>

#include "app/core/model/touch_model.h"
#include "bem/contact/contact_simulation.h"
#include "bem/problem/greens_columns.h"

namespace palpa::app {

/// A contact that does not change while tools press: a grab (displacement, mm) or a force (N).
struct StaticContact {
  bem::ContactTool tool;
  Eigen::Vector3d at, value;  ///< mm on the unloaded shape; see ContactSimulation
};

/// A fingertip or ball that moves along a straight trajectory.
struct MovingTool {
  bem::ContactTool tool;   ///< kPush or kBall
  Eigen::Vector3d at;      ///< mm, on the unloaded shape: where it first meets the surface
  Eigen::Vector3d motion;  ///< mm, from there
};

/// State of the tools at the ends of their trajectories.
struct ToolsAtRest {
  /// One per tool, with the masks that carry force. kSlipping: it slid in the last step of the
  /// trajectory.
  std::vector<bem::ContactSimulation::Contact> contacts;
  TouchState::Path path;
};

/// Moves tools along their trajectories, all at the same time and in steps, because friction
/// depends on the history, and then repeats steps at the ends until no force changes any more
/// (Path::change). `columns`: of the model's problem; missing ones are computed. `field`: the field
/// of loads and static contacts alone; the tools first touch the surface that it displaces.
///
/// `steps` = 0: as many steps as move no tool by more than a hundredth of its radius, at least
/// kMinSteps. A step that is too large for the laws of contact is divided. Forces are computed with
/// single precision columns: exact to 1e-4 of the largest force. Phase of progress: "touch".
///
/// Throws SolverError: kBadCondition for a place on a support, kNotConverged if the tools do not
/// come to rest or the laws cannot be met; Cancelled.
ToolsAtRest moveTools(const TouchModel& model, const bem::ContactSurface& surface,
                      bem::GreensColumns& columns, std::span<const StaticContact> staticContacts,
                      std::span<const MovingTool> tools, const bem::BoundaryField& field, int steps,
                      const Job& job);

/// Position of a tool where it first touches the surface displaced by `field`, as moveTools() has
/// it: the tip of a fingertip, the centre of a ball; mm.
Eigen::Vector3d toolAtFirstContact(const bem::ContactSurface& surface, const bem::ContactTool& tool,
                                   const Eigen::Vector3d& at, const bem::BoundaryField& field);

inline constexpr int kMinSteps = 100;
inline constexpr int kMaxSteps = 10000;

}  // namespace palpa::app
