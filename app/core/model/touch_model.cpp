#include "app/core/model/touch_model.h"

#include <algorithm>

namespace palpa::app {

double TouchState::Contact::patchRadius() const {
  double reach = 0;
  for (const auto& mask : patch)
    reach = std::max(reach, (mask.point.position - at).norm() + 0.5 * mask.radius);
  return reach;
}

TouchState TouchModel::describe(bem::BoundaryField field, std::vector<TouchState::Contact> contacts,
                                const bem::ContactSurface* surface) const {
  TouchState state;
  state.field = std::move(field);
  state.contacts = std::move(contacts);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double largest = 0;
  const auto count = [&](const Eigen::Vector3d& force) {
    sum += force;
    largest = std::max(largest, force.norm());
  };
  // The tractions on a support are what it and any load there exert together.
  const Eigen::VectorXd reaction = state.field.p.col(0) - setup_.conditions.traction;
  for (const auto& support : setup_.supports) {
    state.supports.push_back(
        {support.name, setup_.discretisation->resultant(reaction, support.elements)});
    count(state.supports.back().resultant.force);
  }
  for (const auto& load : setup_.loads) {
    count(load.resultant.force);
    largest = std::max(largest, load.couple);
  }
  for (const auto& contact : state.contacts) count(contact.force);
  state.balance = sum.norm();
  state.relativeBalance = largest > 0 ? state.balance / largest : 0;
  const auto u = state.field.u.col(0), p = state.field.p.col(0);
  state.energy =
      (surface ? surface->strainEnergy(u, p) : setup_.discretisation->strainEnergy(u, p)) +
      bodyForceWork_.value(u, p) / 2;
  return state;
}

}  // namespace palpa::app
