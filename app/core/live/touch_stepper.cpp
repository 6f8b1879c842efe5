#include "app/core/live/touch_stepper.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace palpa::app {

TouchStepper::TouchStepper(std::shared_ptr<const TouchableModel> model, std::uint64_t number)
    : model_(std::move(model)), number_(number), simulation_(model_->simulate()) {
  contacts_.reserve(TouchSnapshot::kMaxContacts);
}

std::vector<TouchStepper::Contact>::iterator TouchStepper::find(TouchId id) {
  return std::find_if(contacts_.begin(), contacts_.end(),
                      [id](const Contact& contact) { return contact.id == id; });
}

bool TouchStepper::hasRoomFor(const bem::ContactTool& tool) const {
  if (contacts_.size() >= TouchSnapshot::kMaxContacts) return false;
  if (!tool.hasPatch()) return true;
  const auto& contacts = simulation_.contacts();
  return std::count_if(contacts.begin(), contacts.end(), [](const auto& contact) {
           return contact.tool.hasPatch();
         }) < TouchSnapshot::kMaxBalls;
}

bool TouchStepper::apply(const TouchCommand& command) {
  using Kind = TouchCommand::Kind;
  const auto place = find(command.id);
  if (command.kind == Kind::kBegin) {
    if (place != contacts_.end() || !hasRoomFor(command.tool)) return false;
    contacts_.push_back({command.id, simulation_.begin(command.tool, command.at, command.value)});
    return true;
  }
  if (place == contacts_.end()) return false;
  if (command.kind == Kind::kSet) {
    simulation_.set(place->inner, command.value);
  } else {
    simulation_.end(place->inner);
    contacts_.erase(place);
  }
  return true;
}

void TouchStepper::takeOver(const TouchStepper& other) {
  simulation_.takeOver(other.simulation_);
  contacts_ = other.contacts_;
  contacts_.reserve(TouchSnapshot::kMaxContacts);
}

void TouchStepper::describe(TouchSnapshot& snapshot) const {
  snapshot.model = number_;
  snapshot.isConverged = simulation_.converged();
  snapshot.residual = simulation_.residual();
  const bem::GreensColumns& columns = *model_->columns();
  snapshot.columnsReady =
      columns.nodeCount() > 0 ? static_cast<double>(columns.readyCount()) / columns.nodeCount() : 1;
  snapshot.contactCount = 0;
  snapshot.patchCount = 0;
  const auto& contacts = simulation_.contacts();
  assert(contacts.size() == contacts_.size());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const bem::ContactSimulation::Contact& from = contacts[k];
    TouchSnapshot::Contact& to = snapshot.contacts[snapshot.contactCount++];
    to = {contacts_[k].id,     from.tool,
          from.status,         from.value,
          from.point,          from.force,
          from.displacement,   from.deflection,
          from.stiffness,      from.normalCompliance,
          snapshot.patchCount, static_cast<int>(from.patch.size())};
    for (const TouchSnapshot::Patch& patch : from.patch)
      snapshot.patches[snapshot.patchCount++] = patch;
  }
}

}  // namespace palpa::app
