#include "app/core/live/touch_field.h"

#include <utility>
#include <vector>

#include "app/core/live/touch_table.h"

namespace palpa::app {

TouchField::TouchField(std::shared_ptr<const TouchableModel> body)
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
  for (const TouchSnapshot::Contact& from : snapshot.touched()) {
    TouchState::Contact contact{from.point.position, from.tool.radius, from.force,
                                from.displacement,   from.stiffness,   nameOf(from.tool.kind)};
    contact.status = from.status;
    contact.normal = body_->surface().normal(from.point);
    contact.friction = from.tool.friction;
    const auto patch = snapshot.pressed(from);
    if (from.tool.kind == bem::ContactTool::Kind::kPush ||
        from.tool.kind == bem::ContactTool::Kind::kProbe) {
      contact.tool = from.value;
      contact.patch.assign(patch.begin(), patch.end());
    }
    contacts.push_back(std::move(contact));
  }
  return body_->model().describe(field(snapshot), std::move(contacts), &body_->surface());
}

}  // namespace palpa::app
