#include "app/core/touch_field.h"

#include <utility>
#include <vector>

namespace palpa::app {

TouchField::TouchField(std::shared_ptr<const TouchBody> body)
    : body_(std::move(body)),
      evaluator_(body_->surface(), *body_->columns(), body_->base()),
      field_(body_->base()) {}

const Eigen::MatrixXd& TouchField::displacements(const TouchSnapshot& snapshot) {
  evaluator_.evaluate(snapshot.pressed(), false, field_);
  return field_.u;
}

const bem::BoundaryField& TouchField::field(const TouchSnapshot& snapshot) {
  evaluator_.evaluate(snapshot.pressed(), true, field_);
  return field_;
}

TouchState TouchField::describe(const TouchSnapshot& snapshot) {
  std::vector<TouchState::Contact> contacts;
  for (const TouchSnapshot::Contact& contact : snapshot.touched())
    contacts.push_back({contact.point.position, contact.tool.radius, contact.force,
                        contact.displacement, contact.stiffness});
  return body_->model().describe(field(snapshot), std::move(contacts), &body_->surface());
}

}  // namespace palpa::app
