#pragma once

#include <span>
#include <vector>

#include "app/core/model/touch_model.h"
#include "bem/contact/contact_simulation.h"

namespace palpa::app {

/// What does not move while tools press: a grabbed place (displacement, mm) or a force (N).
struct HeldPlace {
  bem::ContactTool tool;
  Eigen::Vector3d at, value;  ///< mm on the unloaded shape; see ContactSimulation
};

/// A fingertip or ball on its way.
struct MovingTool {
  bem::ContactTool tool;  ///< kPush or kProbe
  Eigen::Vector3d at;     ///< mm, on the unloaded shape: where it first meets the surface
  Eigen::Vector3d way;    ///< mm, from there
};

struct ToolsAtRest {
  /// One per tool, with the masks that carry force. kSlipping: slid with the last step of the way.
  std::vector<bem::ContactSimulation::Contact> contacts;
  TouchState::Path path;
};

/// Moves tools straight along their ways, all at the same time and in steps, so that friction has a
/// history, and then lets them rest until nothing changes any more (Path::change says how far).
/// `field`: what held places and loads make of the body before the tools come; a tool's first
/// contact is with that.
///
/// `steps` = 0: as many as move no tool by more than a hundredth of its radius, at least
/// kMinSteps. A step that is too large for the laws of contact is divided. Forces are those of
/// single precision columns: 1e-4 of the largest, or better. Phases of progress: "touch".
///
/// Throws SolverError: kBadCondition for a place on a support, kNotConverged when there is no state
/// of rest or the laws cannot be met; Cancelled.
ToolsAtRest moveTools(const TouchModel& model, const bem::ContactSurface& surface,
                      std::span<const HeldPlace> held, std::span<const MovingTool> tools,
                      const bem::BoundaryField& field, int steps, const Job& job);

inline constexpr int kMinSteps = 100;
inline constexpr int kMaxSteps = 10000;

}  // namespace palpa::app
