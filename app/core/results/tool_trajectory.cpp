#include "app/core/results/tool_trajectory.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/core/model/contact_kind.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using Simulation = bem::ContactSimulation;
using Status = Simulation::Status;

/// Largest motion of a tool in a step, over its radius.
constexpr double kStepShare = 0.01;
/// Height above the surface at which tools start, over their radius.
constexpr double kLift = 0.02;
constexpr int kApproachSteps = 5;
/// Number of times that a step may be halved.
constexpr int kMaxHalvings = 5;
/// Tools are at rest if no force changes by more than this part of the largest force. The number of
/// settling steps is limited because a ball creeps slowly if only parts of its patch stick.
constexpr double kSettled = 1e-6;
constexpr int kMaxSettlingSteps = 50;
/// Largest accepted change of a force in a settling step, over the largest force.
constexpr double kMaxCreep = 1e-3;
/// A contact has slid if its reference moves by more than this part of the radius in a step.
constexpr double kSlid = 1e-6;

[[noreturn]] void notConverged(const std::string& message) {
  throw bem::SolverError(bem::SolverError::Kind::kNotConverged, message);
}

int stepsFor(std::span<const MovingTool> tools, int requested) {
  if (requested > 0) return requested;
  double most = 0;
  for (const MovingTool& each : tools)
    most = std::max(most, each.motion.norm() / (kStepShare * each.tool.radius));
  return static_cast<int>(std::clamp<double>(std::ceil(most), kMinSteps, kMaxSteps));
}

/// Position of a tool that just touches the surface displaced by `field`, and the position above it
/// from which it approaches.
struct FirstContact {
  Vector3d start, above;
};

FirstContact firstContact(const bem::ContactSurface& surface, const MovingTool& tool,
                          const bem::BoundaryField& field) {
  const bem::SurfacePoint foot = surface.nearest(tool.at);
  const bool isBall = infoOf(tool.tool.kind).isBall;
  // A ball touches the surface in a point: the narrowest mask that the mesh can carry.
  const double radius = isBall ? 0 : tool.tool.radius;
  const bem::ContactMask mask = bem::makeContactMask(surface, foot.position, radius);
  const Vector3d normal = surface.normal(foot);
  Vector3d start = surface.smoothPosition(foot) + Vector3d(mask.displacement(field.u));
  if (isBall) start += tool.tool.radius * normal;
  return {start, start + kLift * tool.tool.radius * normal};
}

/// Simulation of static contacts and moving tools.
class ToolTrajectory {
 public:
  ToolTrajectory(const TouchModel& model, const bem::ContactSurface& surface,
                 bem::GreensColumns& columns, std::span<const StaticContact> staticContacts,
                 std::span<const MovingTool> tools, const bem::BoundaryField& field, const Job& job)
      : tools_(tools),
        surface_(surface),
        columns_(columns),
        simulation_(surface, columns_, model.rest().field, model.setup().material),
        job_(job) {
    columnsJob_ = job;
    columnsJob_.progress = nullptr;
    for (const StaticContact& contact : staticContacts)
      simulation_.begin(contact.tool, contact.at, contact.value);
    for (const MovingTool& tool : tools) {
      first_.push_back(firstContact(surface, tool, field));
      ids_.push_back(simulation_.begin(tool.tool, tool.at, first_.back().above));
    }
    for (int k = 0; k < kApproachSteps; ++k) step();
  }

  /// Moves the tools to a part of their trajectories. False if the laws cannot be met there.
  bool moveTo(double part) {
    for (std::size_t k = 0; k < ids_.size(); ++k)
      simulation_.set(ids_[k], first_[k].start + part * tools_[k].motion);
    return step();
  }

  /// One more step without motion.
  bool step() {
    job_.throwIfCancelled();
    while (!simulation_.missing().empty())
      columns_.computeAround(simulation_.missing(), surface_.places(), columnsJob_);
    simulation_.step();
    return simulation_.converged();
  }

  std::vector<Simulation::Contact> tools() const {
    std::vector<Simulation::Contact> contacts;
    for (const Simulation::Id id : ids_) contacts.push_back(*simulation_.find(id));
    return contacts;
  }

  double residual() const { return simulation_.residual(); }

 private:
  std::span<const MovingTool> tools_;
  const bem::ContactSurface& surface_;
  bem::GreensColumns& columns_;
  Simulation simulation_;
  const Job& job_;
  Job columnsJob_;
  std::vector<FirstContact> first_;
  std::vector<Simulation::Id> ids_;
};

/// Largest change of a force over the largest force; 0 without forces.
double changeBetween(const std::vector<Simulation::Contact>& before,
                     const std::vector<Simulation::Contact>& now) {
  double change = 0, largest = 0;
  for (std::size_t k = 0; k < now.size(); ++k) {
    change = std::max(change, (now[k].force - before[k].force).norm());
    largest = std::max(largest, now[k].force.norm());
  }
  return largest > 0 ? change / largest : change;
}

/// Goes the whole trajectory in steps of 1 / count, divided where they are too large; returns the
/// tools before and after the last one.
std::array<std::vector<Simulation::Contact>, 2> followTrajectory(ToolTrajectory& trajectory,
                                                                 int count, TouchState::Path& path,
                                                                 const Job& job) {
  std::vector<Simulation::Contact> before = trajectory.tools();
  double done = 0;
  for (int k = 0; k < count; ++k) {
    const double end = (k + 1.0) / count;
    double step = end - done;
    while (done < end) {
      const double next = std::min(done + step, end);
      before = trajectory.tools();
      ++path.steps;
      if (trajectory.moveTo(next)) {
        done = next;
        continue;
      }
      step /= 2;
      if (step * count < std::ldexp(1.0, -kMaxHalvings)) {
        char text[200];
        std::snprintf(text, sizeof text,
                      "the laws of contact cannot be met %.3g of the way along the paths of the "
                      "tools (residual %.2g); less friction, a shorter way or more steps may help",
                      next, trajectory.residual());
        notConverged(text);
      }
    }
    job.report(Phase::kTouch, end);
  }
  return {std::move(before), trajectory.tools()};
}

void settle(ToolTrajectory& trajectory, TouchState::Path& path) {
  bool isConverged = false;
  do {
    const auto before = trajectory.tools();
    isConverged = trajectory.step();
    ++path.settlingSteps;
    path.change = changeBetween(before, trajectory.tools());
    if (isConverged && path.change <= kSettled) return;
  } while (path.settlingSteps < kMaxSettlingSteps);
  if (isConverged && path.change <= kMaxCreep) return;
  char text[240];
  if (isConverged)
    std::snprintf(text, sizeof text,
                  "the tools find no state of rest at the end of their ways: after %d steps there "
                  "forces still change by %.2g of the largest; a finer mesh, another radius or "
                  "less friction may help",
                  path.settlingSteps, path.change);
  else
    std::snprintf(text, sizeof text,
                  "the laws of contact cannot be met at the end of the ways of the tools (residual "
                  "%.2g); less friction, a shorter way or more steps may help",
                  trajectory.residual());
  notConverged(text);
}

}  // namespace

Vector3d toolAtFirstContact(const bem::ContactSurface& surface, const bem::ContactTool& tool,
                            const Vector3d& at, const bem::BoundaryField& field) {
  return firstContact(surface, {tool, at, Vector3d::Zero()}, field).start;
}

ToolsAtRest moveTools(const TouchModel& model, const bem::ContactSurface& surface,
                      bem::GreensColumns& columns, std::span<const StaticContact> staticContacts,
                      std::span<const MovingTool> tools, const bem::BoundaryField& field, int steps,
                      const Job& job) {
  ToolTrajectory trajectory(model, surface, columns, staticContacts, tools, field, job);
  ToolsAtRest result;
  const auto [before, end] = followTrajectory(trajectory, stepsFor(tools, steps), result.path, job);
  settle(trajectory, result.path);
  result.path.residual = trajectory.residual();
  result.contacts = trajectory.tools();
  // At rest nothing slides, so the last step of the trajectory decides which tools have slid.
  for (std::size_t k = 0; k < tools.size(); ++k) {
    Simulation::Contact& contact = result.contacts[k];
    const bool hasSlid =
        (end[k].reference - before[k].reference).norm() > kSlid * contact.tool.radius;
    if (contact.status == Status::kSlipping || contact.status == Status::kSticking)
      contact.status = hasSlid ? Status::kSlipping : Status::kSticking;
  }
  return result;
}

}  // namespace palpa::app
