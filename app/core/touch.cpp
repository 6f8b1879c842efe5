#include "app/core/touch.h"

#include <algorithm>

#include "app/core/probe.h"
#include "bem/contact_solver.h"
#include "bem/nodal_switching.h"

namespace palpa::app {
namespace {

/// Half the width of a thumb's contact under a firm press, mm.
constexpr double kFingertipRadius = 6.0;

[[noreturn]] void badTouch(const std::string& message) {
  throw bem::SolverError(bem::SolverError::Kind::kBadCondition, message);
}

}  // namespace

double defaultTouchRadius(const bem::BoundaryMesh& mesh) {
  return std::min(kFingertipRadius, 0.2 * mesh.boundingSize() / std::sqrt(3.0));
}

TouchState playTouches(const TouchModel& model, std::span<const modeling::Touch> touches) {
  const BoundarySetup& setup = model.setup();
  const bem::DegreesOfFreedom& dofs = model.problem()->dofs();
  bem::ContactSolver solver(model.problem(), setup.slots, model.rest().field);
  for (const modeling::Touch& touch : touches) {
    checkNearSurface(setup.mesh, touch.at, "the touch \"" + touch.name + "\"");
    const bem::ContactMask mask =
        bem::makeContactMask(setup.mesh, setup.slots, dofs, touch.at,
                             touch.radius.value_or(defaultTouchRadius(setup.mesh)));
    if (const auto* moved = std::get_if<modeling::TouchDisplacement>(&touch.action))
      solver.addGrab(mask, moved->vector);
    else
      solver.addForce(mask, std::get<modeling::TouchForce>(touch.action).vector);
  }
  const Eigen::VectorXd forces = solver.forces();
  std::vector<TouchState::Contact> contacts;
  for (const auto& contact : solver.contacts(forces))
    contacts.push_back({contact.point.position, contact.radius, contact.force, contact.displacement,
                        contact.stiffness});
  return model.describe(solver.field(forces), std::move(contacts));
}

TouchState touchNode(const TouchModel& model, int node, const Eigen::Vector3d& displacement) {
  const BoundarySetup& setup = model.setup();
  const bem::DegreesOfFreedom& dofs = model.problem()->dofs();
  if (node < 0 || node >= dofs.nodeCount())
    badTouch("there is no node " + std::to_string(node) + "; nodes are numbered from 0 to " +
             std::to_string(dofs.nodeCount() - 1));
  if (!dofs.isFree(node))
    badTouch("node " + std::to_string(node) + " is held by a support; touch a free one");
  auto greens = std::make_shared<bem::GreensFunction>(model.problem());
  const Eigen::VectorXd unknown = model.problem()->solve(dofs.knownField(setup.conditions)).col(0);
  bem::NodalSwitching switching(greens, Eigen::VectorXd::Zero(dofs.nodalCount()), unknown,
                                model.rest().field);
  switching.add(node);
  // Free nodes have the frame of space, so the values are the components of the displacement.
  auto solution = switching.solve(displacement);
  const Eigen::Vector3d force =
      dofs.tractionScale() * bem::nodalArea(setup.mesh, node) * solution.switched;
  const Eigen::Vector3d moved = displacement - model.rest().field.u.col(0).segment<3>(3 * node);
  const double stiffness = moved.squaredNorm() > 0 ? force.dot(moved) / moved.squaredNorm() : 0.0;
  return model.describe(std::move(solution.field),
                        {{setup.mesh.nodes[node], 0.0, force, displacement, stiffness}});
}

}  // namespace palpa::app
