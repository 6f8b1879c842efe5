#include "app/core/live/touch_field.h"

#include <utility>
#include <vector>

#include "app/core/model/contact_kind.h"

namespace palpa::app {

TouchState::Contact contactOf(const TouchSnapshot& snapshot, const TouchSnapshot::Contact& from,
                              const bem::ContactSurface& surface) {
  TouchState::Contact contact{from.point.position,        from.tool.radius, from.force,
                              from.displacement,          from.deflection,  from.stiffness,
                              touchKindOf(from.tool.kind)};
  contact.status = from.status;
  contact.normal = surface.normal(from.point);
  contact.friction = from.tool.friction;
  const auto patch = snapshot.pressed(from);
  if (from.tool.presses()) {
    contact.tool = from.value;
    contact.patch.assign(patch.begin(), patch.end());
  }
  return contact;
}

TouchField::TouchField(std::shared_ptr<const TouchableModel> model)
    : model_(std::move(model)),
      evaluator_(model_->surface(), *model_->columns(), model_->base()),
      field_(model_->base()) {}

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
    contacts.push_back(contactOf(snapshot, contact, model_->surface()));
  return model_->model().describe(field(snapshot), std::move(contacts), &model_->surface());
}

}  // namespace palpa::app
