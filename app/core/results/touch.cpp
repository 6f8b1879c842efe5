#include "app/core/results/touch.h"

#include <algorithm>

#include "app/core/live/touch_snapshot.h"
#include "app/core/model/contact_kind.h"
#include "app/core/results/field_sample.h"
#include "app/core/results/tool_trajectory.h"
#include "bem/compressed/compressed_reference_problem.h"
#include "bem/contact/bilateral_contact_solver.h"
#include "bem/contact/contact_surface.h"
#include "bem/contact/nodal_switching.h"

namespace palpa::app {
namespace {

[[noreturn]] void badTouch(const std::string& message) {
  throw bem::SolverError(bem::SolverError::Kind::kBadCondition, message);
}

/// Touches as contacts of the solvers, and the state that the solvers compute.
class StaticTouchSolution {
 public:
  StaticTouchSolution(const TouchModel& model, const bem::ContactSurface& surface,
                      std::span<const modeling::Touch> touches)
      : model_(model), surface_(surface), touches_(touches) {
    for (const modeling::Touch& touch : touches) {
      const bem::ContactTool tool{contactKindOf(touch.kind),
                                  touch.radius.value_or(defaultTouchRadius(model.setup().mesh())),
                                  touch.friction};
      if (tool.presses())
        tools_.push_back({tool, touch.at, touch.vector});
      else
        addStatic(touch, tool);
    }
    checkCount();
  }

  const std::vector<StaticContact>& staticContacts() const { return static_; }
  const std::vector<MovingTool>& tools() const { return tools_; }

  /// The state of all touches; `base`: the field of loads and of the tools at rest.
  TouchState describe(bem::BoundaryField base, const ToolsAtRest& tools) const {
    bem::BilateralContactSolver solver(model_.problem(), model_.setup().discretisation->slots(),
                                       std::move(base));
    for (std::size_t k = 0; k < static_.size(); ++k) {
      if (static_[k].tool.kind == bem::ContactTool::Kind::kForce)
        solver.addForce(masks_[k], static_[k].value);
      else
        solver.addGrab(masks_[k], static_[k].value);
    }
    const Eigen::VectorXd forces = solver.forces();
    const auto exact = solver.contacts(forces);
    std::vector<TouchState::Contact> contacts;
    std::size_t nextStatic = 0, nextTool = 0;
    for (const modeling::Touch& touch : touches_) {
      if (!modeling::infoOf(touch.kind).presses)
        contacts.push_back(describe(touch, exact[nextStatic++]));
      else if (!tools.contacts.empty())
        contacts.push_back(describe(touch, tools.contacts[nextTool++]));
    }
    TouchState state = model_.describe(solver.field(forces), std::move(contacts));
    if (!tools.contacts.empty()) state.path = tools.path;
    return state;
  }

 private:
  void addStatic(const modeling::Touch& touch, const bem::ContactTool& tool) {
    masks_.push_back(bem::makeContactMask(surface_, touch.at, tool.radius));
    Eigen::Vector3d value = touch.vector;
    if (touch.kind == modeling::TouchKind::kPin)
      value += Eigen::Vector3d(masks_.back().displacement(model_.rest().field.u));
    static_.push_back({tool, touch.at, value});
  }

  void checkCount() const {
    if (tools_.empty()) return;
    const auto balls = std::count_if(tools_.begin(), tools_.end(),
                                     [](const MovingTool& each) { return each.tool.hasPatch(); });
    if (touches_.size() > TouchSnapshot::kMaxContacts)
      badTouch("there are " + std::to_string(touches_.size()) +
               " touches; beside pushes and balls at most " +
               std::to_string(TouchSnapshot::kMaxContacts) + " can be played at once");
    if (balls > TouchSnapshot::kMaxBalls)
      badTouch("there are " + std::to_string(balls) + " balls; at most " +
               std::to_string(TouchSnapshot::kMaxBalls) + " can be played at once");
  }

  TouchState::Contact describe(const modeling::Touch& touch,
                               const bem::BilateralContactSolver::Contact& from) const {
    TouchState::Contact contact{from.point.position, from.radius,     from.force,
                                from.displacement,   from.deflection, from.stiffness};
    contact.kind = touch.kind;
    contact.name = touch.name;
    contact.normal = surface_.normal(from.point);
    if (!contact.hasGivenForce()) contact.compliance = from.compliance;
    return contact;
  }

  TouchState::Contact describe(const modeling::Touch& touch,
                               const bem::ContactSimulation::Contact& from) const {
    TouchState::Contact contact{from.point.position, from.tool.radius, from.force,
                                from.displacement,   from.deflection,  from.stiffness};
    contact.kind = touch.kind;
    contact.name = touch.name;
    contact.status = from.status;
    contact.normal = surface_.normal(from.point);
    contact.friction = from.tool.friction;
    contact.tool = from.value;
    contact.patch = from.patch;
    // A fingertip's mask may be wider than requested if the mesh cannot carry a narrower one.
    if (from.tool.kind == bem::ContactTool::Kind::kPush && !from.patch.empty())
      contact.radius = from.patch.front().radius;
    return contact;
  }

  const TouchModel& model_;
  const bem::ContactSurface& surface_;
  std::span<const modeling::Touch> touches_;
  std::vector<StaticContact> static_;
  std::vector<bem::ContactMask> masks_;  // of static_
  std::vector<MovingTool> tools_;
};

/// The field of the loads and of the tools' forces.
bem::BoundaryField pressedBy(const TouchModel& model, const bem::ContactSurface& surface,
                             const ToolsAtRest& tools, const Job& job) {
  bem::BoundaryField field = model.rest().field;
  bem::BoundaryField known{Eigen::MatrixXd::Zero(field.u.rows(), 1),
                           Eigen::MatrixXd::Zero(field.p.rows(), 1)};
  const std::vector<int>& firstSlot = model.setup().discretisation->slots().firstOfNode;
  for (const auto& contact : tools.contacts)
    for (const auto& each : contact.patch) {
      const bem::ContactMask mask = bem::makeContactMask(surface, each.point.position, each.radius);
      for (std::size_t k = 0; k < mask.nodes.size(); ++k)
        for (int slot = firstSlot[mask.nodes[k]]; slot < firstSlot[mask.nodes[k] + 1]; ++slot)
          known.p.middleRows<3>(3 * slot) += mask.traction[k] * each.force;
    }
  const bem::BoundaryField pressed =
      model.problem()->solveField(known, bem::ReferenceProblem::Effort::kRefined, job);
  field.u += pressed.u;
  field.p += pressed.p;
  return field;
}

}  // namespace

double defaultTouchRadius(const bem::BoundaryMesh& mesh) {
  return defaultTouchRadius(mesh.boundingSize());
}

TouchPlayer::TouchPlayer(const TouchModel& model)
    : model_(model),
      surface_(model.setup().discretisation->makeContactSurface(model.problem()->dofs())) {}

TouchPlayer::~TouchPlayer() = default;

TouchState TouchPlayer::play(std::span<const modeling::Touch> touches, int steps, const Job& job) {
  for (const modeling::Touch& touch : touches)
    checkNearSurface(model_.setup().mesh(), touch.at, "the touch \"" + touch.name + "\"");
  const StaticTouchSolution solution(model_, *surface_, touches);
  if (solution.tools().empty()) return solution.describe(model_.rest().field, {});
  if (!columns_) columns_ = bem::makeGreensColumns(model_.problem());
  const ToolsAtRest tools =
      moveTools(model_, *surface_, *columns_, solution.staticContacts(), solution.tools(),
                solution.describe(model_.rest().field, {}).field, steps, job);
  bem::BoundaryField base = pressedBy(model_, *surface_, tools, job);
  return solution.describe(std::move(base), tools);
}

TouchState playTouches(const TouchModel& model, std::span<const modeling::Touch> touches, int steps,
                       const Job& job) {
  return TouchPlayer(model).play(touches, steps, job);
}

TouchState touchNode(const TouchModel& model, int node, const Eigen::Vector3d& displacement) {
  const BoundarySetup& setup = model.setup();
  const bem::DegreesOfFreedom& dofs = model.problem()->dofs();
  if (node < 0 || node >= dofs.nodeCount())
    badTouch("there is no node " + std::to_string(node) + "; nodes are numbered from 0 to " +
             std::to_string(dofs.nodeCount() - 1));
  if (!dofs.isFree(node))
    badTouch("node " + std::to_string(node) + " is fixed by a support; touch a free node");
  const bem::Discretisation& on = *setup.discretisation;
  const Eigen::VectorXd unknown =
      model.problem()
          ->solve(dofs.knownField(setup.conditions), bem::ReferenceProblem::Effort::kRefined, {},
                  model.bodyForceTerm())
          .col(0);
  const bem::Discretisation::Weights weights = on.placeWeights();
  bem::NodalSwitching switching(model.problem(), Eigen::VectorXd::Zero(dofs.nodalCount()), unknown,
                                model.rest().field, weights);
  switching.add(node);
  // Free nodes have the frame of space, so the values are the components of the displacement.
  auto solution = switching.solve(displacement);
  const Eigen::Vector3d force = dofs.tractionScale() * on.area(node) * solution.switched;
  Eigen::Vector3d moved = displacement;
  for (bem::Discretisation::Weights::InnerIterator it(weights, node); it; ++it)
    moved -= it.value() * model.rest().field.u.col(0).segment<3>(3 * it.col());
  const double stiffness = moved.norm() > 0 ? force.norm() / moved.norm() : 0.0;
  return model.describe(std::move(solution.field), {{on.places()[node], 0.0, force, displacement,
                                                     moved, stiffness, std::nullopt}});
}

}  // namespace palpa::app
