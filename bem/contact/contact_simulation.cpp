#include "bem/contact/contact_simulation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Kind = ContactTool::Kind;

/// Sliding within a step ends when places move by less than this fraction of the mask's radius.
constexpr double kSettled = 1e-6;
/// Cosine between the normals of a ball's places and of its middle below which a place that faces
/// away from the ball belongs to another face: beside a sharp edge, the nearest place may.
constexpr double kSameFace = 0.5;

}  // namespace

ContactSimulation::ContactSimulation(const ContactSurface& surface, const GreensColumns& columns,
                                     const BoundaryField& base, const Material& material)
    : surface_(surface),
      planeModulus_(material.youngsModulus / (1 - material.poissonRatio * material.poissonRatio)),
      set_(surface, columns, base) {}

ContactSimulation::Id ContactSimulation::begin(const ContactTool& tool, const Vector3d& at,
                                               const Vector3d& value) {
  Contact contact;
  contact.id = next_++;
  contact.tool = tool;
  contact.value = value;
  contact.point = contact.nextPoint = surface_.nearest(at);
  contact.reference = tool.presses() ? value : at;
  contact.firstMask = set_.size();
  contact.maskCount = tool.maskCount();
  contact.patch.reserve(contact.maskCount);
  set_.resize(contact.firstMask + contact.maskCount);
  conditions_.resize(set_.size());
  anchors_.resize(set_.size());
  forces_.forces.conservativeResizeLike(Eigen::VectorXd::Zero(3 * set_.size()));
  contacts_.push_back(std::move(contact));
  isPlaced_ = false;
  return contacts_.back().id;
}

void ContactSimulation::set(Id id, const Vector3d& value) {
  const auto place = std::find_if(contacts_.begin(), contacts_.end(),
                                  [id](const Contact& contact) { return contact.id == id; });
  assert(place != contacts_.end());
  place->value = value;
  isPlaced_ = false;
}

const ContactSimulation::Contact* ContactSimulation::find(Id id) const {
  const auto place = std::find_if(contacts_.begin(), contacts_.end(),
                                  [id](const Contact& contact) { return contact.id == id; });
  return place == contacts_.end() ? nullptr : &*place;
}

void ContactSimulation::end(Id id) {
  const Contact* ended = find(id);
  assert(ended);
  set_.remove(ended->firstMask, ended->maskCount);
  anchors_.erase(anchors_.begin() + ended->firstMask,
                 anchors_.begin() + ended->firstMask + ended->maskCount);
  const Index first = 3 * ended->firstMask, count = 3 * ended->maskCount;
  Eigen::VectorXd& f = forces_.forces;
  const Index after = f.size() - first - count;
  f.segment(first, after) = f.tail(after).eval();
  f.conservativeResize(first + after);
  for (Contact& contact : contacts_)
    if (contact.firstMask > ended->firstMask) contact.firstMask -= ended->maskCount;
  contacts_.erase(contacts_.begin() + (ended - contacts_.data()));
  conditions_.resize(set_.size());
  attempt_.resize(0);
  isPlaced_ = false;
}

void ContactSimulation::clear() {
  while (!contacts_.empty()) end(contacts_.back().id);
}

void ContactSimulation::takeOver(const ContactSimulation& other) {
  const auto sameTriangles = surface_.mesh().triangles == other.surface_.mesh().triangles;
  contacts_ = other.contacts_;
  for (Contact& contact : contacts_) {
    contact.patch.reserve(contact.maskCount);
    SurfacePoint& point = contact.point;
    if (sameTriangles)
      point = surface_.at(point.triangle, point.weights);
    else
      point = surface_.nearest(point.position);
  }
  set_.resize(other.set_.size());
  conditions_.resize(other.conditions_.size());
  anchors_ = other.anchors_;
  forces_ = other.forces_;
  attempt_ = other.attempt_;
  next_ = other.next_;
  isPlaced_ = false;
}

const std::vector<int>& ContactSimulation::missing() {
  set_.forgetMissing();
  for (Contact& contact : contacts_) {
    // The search for the foot depends on its previous result, so step() must start from the same
    // point.
    const SurfacePoint point = contact.point;
    const Vector3d across = contact.across;
    placeMasks(contact);
    contact.nextPoint = std::exchange(contact.point, point);
    contact.nextAcross = std::exchange(contact.across, across);
  }
  isPlaced_ = set_.missing().empty();
  return set_.missing();
}

std::optional<ContactSimulation::WaitingPlace> ContactSimulation::waiting() const {
  for (const Contact& contact : contacts_)
    if (!contact.tool.hasPatch() && set_.isPlaced(contact.firstMask) &&
        !set_.isAvailable(contact.firstMask))
      return WaitingPlace{set_.mask(contact.firstMask).point, contact.tool.radius};
  return std::nullopt;
}

void ContactSimulation::placeAll() {
  if (std::exchange(isPlaced_, false)) {
    for (Contact& contact : contacts_) {
      contact.point = contact.nextPoint;
      contact.across = contact.nextAcross;
    }
    return;
  }
  set_.forgetMissing();
  for (Contact& contact : contacts_) placeMasks(contact);
}

void ContactSimulation::step(int slides) {
  before_ = forces_;
  for (int slide = 0; slide < std::max(slides, 1); ++slide) {
    placeAll();
    set_.update();
    displacements_.noalias() = set_.freeDisplacements() + set_.compliance() * forces_.forces;
    for (Contact& contact : contacts_) {
      lift(contact);
      demand(contact);
    }
    if (attempt_.size() == forces_.forces.size()) forces_.forces = attempt_;
    system_.solve(set_.compliance(), set_.freeDisplacements(), conditions_, forces_);
    if (!forces_.converged && forces_.softness == 0) {
      attempt_ = forces_.forces;
      forces_.forces = before_.forces;
      return;
    }
    attempt_.resize(0);
    displacements_.noalias() = set_.freeDisplacements() + set_.compliance() * forces_.forces;
    double moved = 0;
    for (Contact& contact : contacts_) {
      read(contact);
      moved = std::max(moved, this->slide(contact));
    }
    if (moved <= kSettled) break;
  }
}

ContactSimulation::MaskState ContactSimulation::maskState(int mask) const {
  return {set_.mask(mask), conditions_[mask], forces_.statuses[mask],
          forces_.forces.segment<3>(3 * mask), displacementOf(mask)};
}

Vector3d ContactSimulation::displacementOf(int mask) const {
  return displacements_.segment<3>(3 * mask);
}

/// Stores the displacement of a contact's middle caused by everything except the contact.
void ContactSimulation::lift(Contact& contact) const {
  const Index middle = 3 * contact.firstMask, count = 3 * contact.maskCount;
  contact.lifted =
      displacements_.segment<3>(middle) -
      set_.compliance().block(middle, middle, 3, count) * forces_.forces.segment(middle, count);
}

/// Sets the conditions of a contact's masks.
void ContactSimulation::demand(const Contact& contact) {
  for (int k = 0; k < contact.maskCount; ++k) {
    const int mask = contact.firstMask + k;
    ContactCondition& condition = conditions_[mask];
    condition = {};
    if (!set_.isPlaced(mask) || !set_.isReady(mask)) {
      condition.kind = ContactCondition::Kind::kForce;  // zero force
      continue;
    }
    condition.value = contact.value;
    switch (contact.tool.kind) {
      case Kind::kGrab:
        continue;
      case Kind::kForce:
        condition.kind = ContactCondition::Kind::kForce;
        continue;
      case Kind::kPush:
      case Kind::kBall:
        condition.kind = ContactCondition::Kind::kUnilateral;
    }
    condition.friction = contact.tool.friction;
    const SurfacePoint& point = set_.mask(mask).point;
    const Vector3d outward = surface_.normal(point);
    condition.normal = -outward;
    double closed = 0;
    if (contact.tool.kind == Kind::kBall) {
      // Away from the ball's centre, for the displaced position of the place.
      const Vector3d away = point.position + displacementOf(mask) - contact.value;
      if (away.dot(outward) < 0) {
        condition.normal = away.normalized();
      } else if (outward.dot(surface_.normal(contact.point)) < kSameFace) {
        condition = {};
        condition.kind = ContactCondition::Kind::kForce;  // cannot touch: zero force
        continue;
      }
      closed = -gapToBall(contact, mask, condition.normal);
    } else {
      closed = condition.normal.dot(contact.value - surface_.smoothPosition(point));
    }
    // Along the normal: the gap, linear in d. Along the surface: the slip relative to the
    // displacement the place would have if it had stuck to the tool since the first contact or the
    // last slip.
    const Vector3d& m = condition.normal;
    const Anchor& anchor = anchors_[mask];
    const Vector3d stuck =
        anchor.isKnown ? Vector3d(contact.value + anchor.displacement) : displacementOf(mask);
    condition.value = m * closed + (stuck - m * m.dot(stuck));
  }
}

void ContactSimulation::read(Contact& contact) {
  contact.force.setZero();
  contact.patch.clear();
  const int middle = contact.firstMask;
  bool isPressing = false, isSlipping = false;
  for (int mask = middle; mask < middle + contact.maskCount; ++mask) {
    const Vector3d force = forces_.forces.segment<3>(3 * mask);
    if (force.isZero(0)) continue;
    contact.force += force;
    contact.patch.push_back({set_.mask(mask).point, set_.mask(mask).radius, force});
    isPressing = true;
    isSlipping = isSlipping || forces_.statuses[mask] == ContactStatus::kSlipping;
  }
  contact.displacement = displacementOf(middle);
  const Index first = 3 * middle, count = 3 * contact.maskCount;
  contact.deflection.noalias() =
      set_.compliance().block(first, first, 3, count) * forces_.forces.segment(first, count);
  const double deflection = contact.deflection.norm();
  contact.stiffness = deflection > 0 ? contact.force.norm() / deflection : 0.0;
  contact.normalCompliance = 0;
  if (set_.isPlaced(middle) && set_.isReady(middle)) {
    const Vector3d n = surface_.normal(contact.point);
    contact.normalCompliance = n.dot(set_.compliance().block<3, 3>(first, first) * n);
  }
  contact.status = !set_.isPlaced(middle)    ? Status::kFixed
                   : !set_.isReady(middle)   ? Status::kWaiting
                   : !contact.tool.presses() ? Status::kGrabbed
                   : !isPressing             ? Status::kOpen
                   : isSlipping              ? Status::kSlipping
                                             : Status::kSticking;
}

/// Updates the anchors of slipping masks, the rotation below a ball, and the reference of the tool
/// if its middle mask slips; returns the motion of the place over the tool's radius.
double ContactSimulation::slide(Contact& contact) {
  if (!contact.tool.presses()) return 0;
  const int middle = contact.firstMask;
  double motion = 0;
  if (contact.tool.kind == Kind::kBall && set_.isPlaced(middle) && set_.isReady(middle)) {
    contact.farCompliance = farCompliance(middle, surface_.normal(contact.point));
    motion = roll(contact);
  }
  for (int mask = middle; mask < middle + contact.maskCount; ++mask) {
    Anchor& anchor = anchors_[mask];
    if (!anchor.isKnown || forces_.statuses[mask] != ContactStatus::kSticking)
      anchor.displacement = displacementOf(mask) - contact.value;
    anchor.isKnown = set_.isPlaced(mask) && set_.isReady(mask);
  }
  motion /= std::max(contact.tool.radius, 1e-12);
  if (forces_.statuses[middle] == ContactStatus::kSticking) return motion;
  // Above the place below the tool, or the place that it would touch first.
  const Vector3d normal = surface_.normal(contact.point);
  const Vector3d moved = displacementOf(middle);
  const Vector3d next = contact.value - (moved - normal * normal.dot(moved));
  motion += (next - contact.reference).norm() / std::max(contact.tool.radius, 1e-12);
  contact.reference = next;
  return motion;
}

void ContactSimulation::tractions(std::vector<int>& nodes, std::vector<Vector3d>& values) const {
  nodes.clear();
  values.clear();
  for (int k = 0; k < set_.size(); ++k) {
    const Vector3d force = forces_.forces.segment<3>(3 * k);
    if (force.isZero(0)) continue;
    const ContactMask& mask = set_.mask(k);
    for (std::size_t i = 0; i < mask.nodes.size(); ++i) {
      const auto place = std::find(nodes.begin(), nodes.end(), mask.nodes[i]);
      const Vector3d traction = mask.traction[i] * force;
      if (place != nodes.end()) {
        values[place - nodes.begin()] += traction;
      } else {
        nodes.push_back(mask.nodes[i]);
        values.push_back(traction);
      }
    }
  }
}

}  // namespace palpa::bem
