#include "tests/reliability/hand.h"

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

Vector3d Hand::valueOf(const Held& held) {
  const Vector3d aside(pickReal(random_, -1, 1), pickReal(random_, -1, 1),
                       pickReal(random_, -1, 1));
  const double depth = pickReal(random_, -0.5, 2);
  switch (held.tool.kind) {
    case Kind::kGrab:
      return aside - depth * held.place.normal;
    case Kind::kPush:
      return held.place.at + 2 * aside - depth * held.place.normal;
    case Kind::kProbe:
      return held.place.at + 2 * aside + (held.tool.radius - depth) * held.place.normal;
    case Kind::kForce:
      return 0.2 * (aside - depth * held.place.normal);
  }
  return Vector3d::Zero();
}

void Hand::begin(const std::vector<Place>& places) {
  constexpr std::array kKinds{Kind::kGrab, Kind::kPush, Kind::kProbe, Kind::kForce};
  Held held;
  held.tool.kind = kKinds[static_cast<std::size_t>(pick(random_, 0, 3))];
  held.tool.radius = pickReal(random_, 4, 9);
  if (held.tool.isPushing()) held.tool.friction = pickReal(random_, 0, 1);
  held.place =
      places[static_cast<std::size_t>(pick(random_, 0, static_cast<int>(places.size()) - 1))];
  try {
    held.id = loop_.begin(held.tool, held.place.at, valueOf(held));
    held_.push_back(held);
    ++begun_;
  } catch (const app::TouchRefused&) {
    ++refused_;  // there is no place left
  }
}

void Hand::act(const std::vector<Place>& places) {
  const auto which = [this] {
    return static_cast<std::size_t>(pick(random_, 0, static_cast<int>(held_.size()) - 1));
  };
  if (held_.empty() || (static_cast<int>(held_.size()) < most_ && oneIn(random_, 12))) {
    loop_.expect(
        places[static_cast<std::size_t>(pick(random_, 0, static_cast<int>(places.size()) - 1))].at);
    begin(places);
  } else if (oneIn(random_, 15)) {
    const std::size_t k = which();
    loop_.end(held_[k].id);
    held_.erase(held_.begin() + static_cast<std::ptrdiff_t>(k));
  } else {
    const Held& held = held_[which()];
    loop_.set(held.id, valueOf(held));
    ++moved_;
  }
}

void Hand::letGoOfAll() {
  for (const Held& held : held_) loop_.end(held.id);
  held_.clear();
}

}  // namespace palpa::reliability
