#include "tests/reliability/touch_user.h"

#include <Eigen/Geometry>

namespace palpa::reliability {

using Eigen::Vector3d;
using Kind = bem::ContactTool::Kind;

std::vector<Place> placesOf(const app::TouchModel& model) {
  const modeling::SurfaceMesh& mesh = model.surface();
  std::vector<Place> places;
  for (const Vector3d& position : mesh.positions) places.push_back({position, Vector3d::Zero()});
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3d area = (places[b].at - places[a].at).cross(places[c].at - places[a].at);
    for (const int corner : {a, b, c}) places[corner].normal += area;
  }
  for (Place& place : places) place.normal.normalize();
  return places;
}

Vector3d TouchUser::valueOf(const Contact& contact) {
  const Vector3d aside(pickReal(random_, -1, 1), pickReal(random_, -1, 1),
                       pickReal(random_, -1, 1));
  const double depth = pickReal(random_, -0.5, 2);
  switch (contact.tool.kind) {
    case Kind::kGrab:
      return aside - depth * contact.place.normal;
    case Kind::kPush:
      return contact.place.at + 2 * aside - depth * contact.place.normal;
    case Kind::kBall:
      return contact.place.at + 2 * aside + (contact.tool.radius - depth) * contact.place.normal;
    case Kind::kForce:
      return 0.2 * (aside - depth * contact.place.normal);
  }
  return Vector3d::Zero();
}

void TouchUser::begin(const std::vector<Place>& places) {
  constexpr std::array kKinds{Kind::kGrab, Kind::kPush, Kind::kBall, Kind::kForce};
  Contact contact;
  contact.tool.kind = kKinds[static_cast<std::size_t>(pick(random_, 0, 3))];
  contact.tool.radius = pickReal(random_, 4, 9);
  if (contact.tool.presses()) contact.tool.friction = pickReal(random_, 0, 1);
  contact.place =
      places[static_cast<std::size_t>(pick(random_, 0, static_cast<int>(places.size()) - 1))];
  try {
    contact.id = loop_.begin(contact.tool, contact.place.at, valueOf(contact));
    contacts_.push_back(contact);
    ++begun_;
  } catch (const app::TouchRefused&) {
    ++refused_;  // the loop has no slot left
  }
}

void TouchUser::act(const std::vector<Place>& places) {
  const auto which = [this] {
    return static_cast<std::size_t>(pick(random_, 0, static_cast<int>(contacts_.size()) - 1));
  };
  if (contacts_.empty() ||
      (static_cast<int>(contacts_.size()) < maxContacts_ && oneIn(random_, 12))) {
    loop_.expect(
        places[static_cast<std::size_t>(pick(random_, 0, static_cast<int>(places.size()) - 1))].at);
    begin(places);
  } else if (oneIn(random_, 15)) {
    const std::size_t k = which();
    loop_.end(contacts_[k].id);
    contacts_.erase(contacts_.begin() + static_cast<std::ptrdiff_t>(k));
  } else {
    const Contact& contact = contacts_[which()];
    loop_.set(contact.id, valueOf(contact));
    ++moved_;
  }
}

void TouchUser::endAll() {
  for (const Contact& contact : contacts_) loop_.end(contact.id);
  contacts_.clear();
}

}  // namespace palpa::reliability
