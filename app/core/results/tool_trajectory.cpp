#include "app/core/results/tool_trajectory.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bem/problem/greens_columns.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using Simulation = bem::ContactSimulation;
using Status = Simulation::Status;

/// No tool moves farther in a step, in parts of its radius.
constexpr double kStepShare = 0.01;
/// Tools come from this far above the surface, in parts of their radius.
constexpr double kLift = 0.02;
constexpr int kApproachSteps = 5;
/// A step is divided at most this often by two.
constexpr int kMaxHalvings = 5;
/// Rest is sought until no force changes by more than this part of the largest, but not for longer
/// than so many steps: where only parts of a ball's patch stick, it goes on creeping slowly.
constexpr double kSettled = 1e-6;
constexpr int kMaxSettlingSteps = 50;
/// More than this in a step is no rest.
constexpr double kMaxCreep = 1e-3;
/// A reference that moves by more than this part of the radius in a step has slid.
constexpr double kSlid = 1e-6;

[[noreturn]] void notConverged(const std::string& message) {
  throw bem::SolverError(bem::SolverError::Kind::kNotConverged, message);
}

int stepsFor(std::span<const MovingTool> tools, int wanted) {
  if (wanted > 0) return wanted;
  double most = 0;
  for (const MovingTool& each : tools)
    most = std::max(most, each.way.norm() / (kStepShare * each.tool.radius));
  return static_cast<int>(std::clamp<double>(std::ceil(most), kMinSteps, kMaxSteps));
}

/// Where a tool is when it just touches the surface as `field` leaves it, and from where it comes.
struct FirstContact {
  Vector3d start, above;
};

FirstContact firstContact(const bem::ContactSurface& surface, const MovingTool& tool,
                          const bem::BoundaryField& field) {
  const bem::SurfacePoint foot = surface.nearest(tool.at);
  const bool isBall = tool.tool.kind == bem::ContactTool::Kind::kProbe;
  // A ball meets the surface in a point: as narrow a mask as the mesh can carry.
  const double radius = isBall ? 0 : tool.tool.radius;
  const bem::ContactMask mask = bem::makeContactMask(surface, foot.position, radius);
  const Vector3d normal = surface.normal(foot);
  Vector3d start = surface.smoothPosition(foot) + Vector3d(mask.displacement(field.u));
  if (isBall) start += tool.tool.radius * normal;
  return {start, start + kLift * tool.tool.radius * normal};
}

/// The simulation of held places and tools.
class ToolTrajectory {
 public:
  ToolTrajectory(const TouchModel& model, const bem::ContactSurface& surface,
                 std::span<const HeldPlace> held, std::span<const MovingTool> tools,
                 const bem::BoundaryField& field, const Job& job)
      : tools_(tools),
        columns_(model.problem()),
        simulation_(surface, columns_, model.rest().field),
        job_(job) {
    columnsJob_ = job;
    columnsJob_.progress = nullptr;
    for (const HeldPlace& place : held) simulation_.begin(place.tool, place.at, place.value);
    for (const MovingTool& tool : tools) {
      first_.push_back(firstContact(surface, tool, field));
      ids_.push_back(simulation_.begin(tool.tool, tool.at, first_.back().above));
    }
    for (int k = 0; k < kApproachSteps; ++k) step();
  }

  /// Puts the tools at a part of their ways. False when the laws cannot be met there.
  bool moveTo(double part) {
    for (std::size_t k = 0; k < ids_.size(); ++k)
      simulation_.set(ids_[k], first_[k].start + part * tools_[k].way);
    return step();
  }

  /// One more step with everything where it is.
  bool step() {
    job_.throwIfCancelled();
    while (!simulation_.missing().empty()) columns_.compute(simulation_.missing(), columnsJob_);
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
  bem::GreensColumns columns_;
  Simulation simulation_;
  const Job& job_;
  Job columnsJob_;
  std::vector<FirstContact> first_;
  std::vector<Simulation::Id> ids_;
};

/// Largest change of a force over the largest force; 0 when there is none.
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
    job.report("touch", end);
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

ToolsAtRest moveTools(const TouchModel& model, const bem::ContactSurface& surface,
                      std::span<const HeldPlace> held, std::span<const MovingTool> tools,
                      const bem::BoundaryField& field, int steps, const Job& job) {
  ToolTrajectory trajectory(model, surface, held, tools, field, job);
  ToolsAtRest result;
  const auto [before, end] = followTrajectory(trajectory, stepsFor(tools, steps), result.path, job);
  settle(trajectory, result.path);
  result.path.residual = trajectory.residual();
  result.contacts = trajectory.tools();
  // At rest nothing slides, so what slid is known from the step before.
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
