#include "app/core/design/contact_stiffness.h"

#include "bem/base/error.h"

namespace palpa::app {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

/// Adds the traction of a mask with the forces in the columns of `forces`, one per column of `p`.
void addTraction(const bem::ContactMask& mask, const Matrix3Xd& forces,
                 const std::vector<int>& firstSlot, Eigen::MatrixXd& p) {
  for (std::size_t k = 0; k < mask.nodes.size(); ++k)
    for (int slot = firstSlot[mask.nodes[k]]; slot < firstSlot[mask.nodes[k] + 1]; ++slot)
      p.middleRows<3>(3 * static_cast<Eigen::Index>(slot)) += mask.traction[k] * forces;
}

class Solver {
 public:
  Solver(const bem::ReferenceProblem& problem, const bem::TractionSlots& slots, const Job& job)
      : problem_(problem), slots_(slots), job_(job) {}

  /// Fields of loads on masks; `forces`: per mask, one column per field.
  bem::BoundaryField fields(const std::vector<bem::ContactMask>& masks,
                            const std::vector<Matrix3Xd>& forces) const {
    bem::BoundaryField known{
        Eigen::MatrixXd::Zero(problem_.dofs().nodalCount(), forces.front().cols()),
        Eigen::MatrixXd::Zero(3 * slots_.count(), forces.front().cols())};
    for (std::size_t m = 0; m < forces.size(); ++m)
      addTraction(masks[m], forces[m], slots_.firstOfNode, known.p);
    return problem_.solveField(known, bem::ReferenceProblem::Effort::kRefined, job_);
  }

 private:
  const bem::ReferenceProblem& problem_;
  const bem::TractionSlots& slots_;
  const Job& job_;
};

/// k = |f| with f = D⁻¹ e: dk = − (D⁻¹ f/|f|) · dD f.
void solveGrab(const Solver& solver, const Vector3d& deflection, ContactStiffness& result) {
  const bem::BoundaryField unit = solver.fields(result.masks, {Matrix3d::Identity()});
  const Matrix3d computed = result.masks.front().displacement(unit.u);
  const Matrix3d compliance = (computed + computed.transpose()) / 2;
  const Vector3d force = compliance.inverse() * deflection;
  const Vector3d adjoint = compliance.inverse() * force.normalized();
  result.value = force.norm();
  result.loadForces = force;
  result.adjointForces = adjoint;
  result.load = {unit.u * force, unit.p * force};
  result.adjoint = {unit.u * adjoint, unit.p * adjoint};
}

/// k = 1 / |g| with the displacement g = Σ D_0m f_m of the first mask: dk = − k² g/|g| · dD f.
void solveForces(const Solver& solver, const StiffnessRule& rule, ContactStiffness& result) {
  std::vector<Matrix3Xd> forces;
  for (const StiffnessRule::Mask& mask : rule.masks) forces.emplace_back(mask.force);
  result.load = solver.fields(result.masks, forces);
  const Vector3d deflection = result.masks.front().displacement(result.load.u);
  result.value = 1 / deflection.norm();
  const Vector3d adjoint = result.value * result.value * deflection.normalized();
  result.adjoint = solver.fields({result.masks.front()}, {adjoint});
  result.loadForces.resize(3, static_cast<Eigen::Index>(forces.size()));
  result.adjointForces = Matrix3Xd::Zero(3, static_cast<Eigen::Index>(forces.size()));
  for (std::size_t m = 0; m < forces.size(); ++m)
    result.loadForces.col(static_cast<Eigen::Index>(m)) = forces[m];
  result.adjointForces.col(0) = adjoint;
}

}  // namespace

StiffnessRule stiffnessRuleOf(const TouchState::Contact& contact) {
  if (!(contact.force.norm() > 0) || !(contact.deflection.norm() > 0))
    throw bem::SolverError(bem::SolverError::Kind::kBadCondition,
                           "the touch \"" + contact.name +
                               "\" has no force, so that its stiffness has no gradient; move it "
                               "into the body");
  StiffnessRule rule;
  rule.name = contact.name;
  rule.masks.push_back({contact.at, contact.radius});
  if (!contact.presses() && contact.kind != modeling::TouchKind::kForce) {
    rule.deflection = contact.deflection.normalized();
    return rule;
  }
  const double size = contact.force.norm();
  if (contact.patch.empty()) {
    rule.masks.front().force = contact.force / size;
    return rule;
  }
  // The middle mask, at which the deflection is taken, is the first one, with or without a force.
  rule.masks.front().radius = contact.patch.front().radius;
  for (const auto& each : contact.patch) {
    const Vector3d force = each.force / size;
    if ((each.point.position - contact.at).norm() < 1e-6 * each.radius)
      rule.masks.front() = {contact.at, each.radius, force};
    else
      rule.masks.push_back({each.point.position, each.radius, force});
  }
  return rule;
}

ContactStiffness contactStiffness(const bem::ReferenceProblem& problem,
                                  const bem::ContactSurface& surface, const StiffnessRule& rule,
                                  const Job& job) {
  ContactStiffness result;
  for (const StiffnessRule::Mask& mask : rule.masks)
    result.masks.push_back(bem::makeContactMask(surface, mask.at, mask.radius));
  const Solver solver(problem, surface.slots(), job);
  if (rule.keepsDeflection())
    solveGrab(solver, rule.deflection, result);
  else
    solveForces(solver, rule, result);
  return result;
}

}  // namespace palpa::app
