#include "bem/contact_simulation.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "bem/contact_foot.h"

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Kind = ContactTool::Kind;

constexpr int kRings = 4;
constexpr int kLattice = 1 + 3 * kRings * (kRings + 1);
static_assert(kLattice == ContactSimulation::kProbeMasks);
/// The lattice reaches this much farther than the contact between two balls would (H. Hertz).
constexpr double kMargin = 1.3;
/// Masks of the lattice overlap: radius over spacing, where the spacing is at least that of the
/// nodes. The narrowest that the mesh can carry (1.25) would do, but how wide these are in effect
/// depends on where they lie among the nodes: by up to a third of their mean ρ^2, which is felt.
constexpr double kOverlap = 1.7;
/// A lattice point that lies farther than this part of the spacing from the surface point it falls
/// on (beyond an edge of the body) is left out.
constexpr double kFarthest = 0.6;
/// Places are looked for from this part of a mask's radius above the surface.
constexpr double kLift = 0.2;
/// A mask of radius r on a half-space yields to the force F of a ball by c F / (E* r), c =
/// 0.7665 (the mean under (1 - ρ^2 / r^2)^2), a circle of contact a by Hertz's a^2 / R with F = 4/3
/// E* a^3 / R. So a mask that stands for a circle x = a / r must meet the ball when that has come
/// nearer by (x^2 - kNarrow x^3) r^2 / R with kNarrow = 4 c / 3; up to where this is the mean gap
/// r^2 / 8 R of a mask that is pressed all over.
constexpr double kNarrow = 1.022, kNarrowContact = 0.5126;
/// Sliding within a step ends when places move by less than this part of the mask's radius.
constexpr double kSettled = 1e-6;

/// Points of a hexagonal lattice with spacing 1 around the origin, ring by ring.
const std::array<Vector2d, kLattice>& lattice() {
  static const auto points = [] {
    std::array<Vector2d, kLattice> result;
    int count = 0;
    result[count++] = Vector2d::Zero();
    const auto corner = [](int k) {
      return Vector2d(std::cos(k * std::numbers::pi / 3), std::sin(k * std::numbers::pi / 3));
    };
    for (int ring = 1; ring <= kRings; ++ring)
      for (int side = 0; side < 6; ++side)
        for (int k = 0; k < ring; ++k)
          result[count++] = ring * corner(side) + k * (corner(side + 1) - corner(side));
    return result;
  }();
  return points;
}

bool isPushing(const ContactTool& tool) {
  return tool.kind == Kind::kPush || tool.kind == Kind::kProbe;
}

/// `direction` turned as little as needed to lie in the plane across the unit normal.
Vector3d inPlane(const Vector3d& direction, const Vector3d& normal) {
  const Vector3d flat = direction - normal * normal.dot(direction);
  return flat.norm() > 1e-6 ? flat.normalized() : normal.unitOrthogonal();
}

}  // namespace

ContactSimulation::ContactSimulation(const ContactSurface& surface, const GreensColumns& columns,
                                     const BoundaryField& base)
    : surface_(surface), set_(surface, columns, base) {}

ContactSimulation::Id ContactSimulation::begin(const ContactTool& tool, const Vector3d& at,
                                               const Vector3d& value) {
  Contact contact;
  contact.id = next_++;
  contact.tool = tool;
  contact.value = value;
  contact.point = surface_.tree().nearest(at);
  contact.reference = isPushing(tool) ? value : at;
  contact.across = inPlane(Vector3d::UnitX(), surface_.normal(contact.point));
  contact.firstMask = set_.size();
  contact.maskCount = tool.kind == Kind::kProbe ? kLattice : 1;
  contact.patch.reserve(contact.maskCount);
  set_.resize(contact.firstMask + contact.maskCount);
  conditions_.resize(set_.size());
  forces_.forces.conservativeResizeLike(Eigen::VectorXd::Zero(3 * set_.size()));
  contacts_.push_back(std::move(contact));
  return contacts_.back().id;
}

void ContactSimulation::set(Id id, const Vector3d& value) {
  const auto place = std::find_if(contacts_.begin(), contacts_.end(),
                                  [id](const Contact& contact) { return contact.id == id; });
  assert(place != contacts_.end());
  place->value = value;
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
      point.position = surface_.mesh().point(point.triangle, point.weights);
    else
      point = surface_.tree().nearest(point.position);
  }
  set_.resize(other.set_.size());
  conditions_.resize(other.conditions_.size());
  forces_ = other.forces_;
  attempt_ = other.attempt_;
  next_ = other.next_;
}

const std::vector<int>& ContactSimulation::missing() {
  set_.forgetMissing();
  for (Contact& contact : contacts_) {
    // Where a tool is looked for depends on where it was before, so step() must find that again.
    const SurfacePoint point = contact.point;
    const Vector3d across = contact.across;
    placeMasks(contact);
    contact.point = point;
    contact.across = across;
  }
  return set_.missing();
}

void ContactSimulation::placeAll() {
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

void ContactSimulation::placeMasks(Contact& contact) {
  if (!isPushing(contact.tool)) {
    set_.place(contact.firstMask, contact.point, contact.tool.radius);
    return;
  }
  contact.point = footOf(contact);
  contact.across = inPlane(contact.across, surface_.normal(contact.point));
  if (contact.tool.kind == Kind::kPush)
    set_.place(contact.firstMask, contact.point, contact.tool.radius);
  else
    placeProbe(contact);
}

/// The surface point below a tool's reference. Looked for from a little above the surface: the
/// nearest point moves without jumps seen from outside a convex mesh, but jumps from face to face
/// seen from inside.
SurfacePoint ContactSimulation::footOf(const Contact& contact) const {
  const Vector3d normal = surface_.normal(contact.point);
  const double height = normal.dot(contact.reference - contact.point.position);
  const double wanted = kLift * surface_.narrowestMask(contact.point);
  const Vector3d from = contact.reference + std::max(wanted - height, 0.0) * normal;
  return smoothFoot(surface_, contact.reference, surface_.tree().nearest(from));
}

/// Of the surface around a contact, from normals at a distance (mm); positive where it bulges.
double ContactSimulation::meanCurvature(const Contact& contact, double distance) const {
  const Vector3d normal = surface_.normal(contact.point);
  const Vector3d across = normal.cross(contact.across);
  double sum = 0;
  for (const Vector3d& direction :
       {contact.across, Vector3d(-contact.across), across, Vector3d(-across)}) {
    const SurfacePoint point = surface_.tree().nearest(
        contact.point.position + distance * direction + kLift * distance * normal);
    const double apart = (point.position - contact.point.position).dot(direction);
    if (apart > 0) sum += (surface_.normal(point) - normal).dot(direction) / apart;
  }
  return sum / 4;
}

/// The masks of a ball: wherever the surface without it reaches into it, the contact lies within
/// that part. The lattice is as fine as the mesh, or wide enough to cover the contact.
void ContactSimulation::placeProbe(Contact& contact) {
  const double radius = contact.tool.radius;
  const Vector3d normal = surface_.normal(contact.point);
  const Vector3d along = contact.across, across = normal.cross(along);
  const Vector3d ball = contact.value - contact.lifted;  // as the surface without it sees it
  const double depth =
      std::clamp(radius - (ball - contact.point.position).dot(normal), 0.0, 2 * radius);
  const double finest = surface_.narrowestMask(contact.point) / ContactSurface::kNarrowest;
  const double curvature = 1 / radius + meanCurvature(contact, finest);
  const double reach = curvature * radius * radius > depth ? std::sqrt(depth / curvature) : radius;
  const double spacing = std::max(finest, kMargin * reach / (kRings + 0.5));
  for (int k = 0; k < contact.maskCount; ++k) {
    const int mask = contact.firstMask + k;
    const Vector2d at = spacing * lattice()[k];
    const Vector3d wanted =
        contact.point.position + at[0] * along + at[1] * across + kLift * spacing * normal;
    const SurfacePoint point = k == 0 ? contact.point : surface_.tree().nearest(wanted);
    const Vector3d off = point.position - wanted;
    const double aside = (off - normal * normal.dot(off)).norm();
    const bool isInside = (point.position - ball).norm() < radius || k == 0;
    if (isInside && aside <= kFarthest * spacing)
      set_.place(mask, point, kOverlap * spacing);
    else
      set_.clear(mask);
  }
}

/// Notes by how much all else moves the middle of a contact.
void ContactSimulation::lift(Contact& contact) const {
  const Index middle = 3 * contact.firstMask, count = 3 * contact.maskCount;
  contact.lifted =
      displacements_.segment<3>(middle) -
      set_.compliance().block(middle, middle, 3, count) * forces_.forces.segment(middle, count);
}

/// How far a mask of the unloaded surface is from a ball along the direction `m` of its pressure,
/// in the mean: ∫ Φ [m . (x - c) - √(R^2 - t^2)] dΓ with t what lies across m, for which the
/// surface is taken where it is now. That is what the mask's mean displacement must make up for. At
/// nodes the mesh lies on the true surface, and between them Ψ recovers it as it does
/// displacements. (At the middle alone the gap would be smaller by the mask's radius squared over 8
/// radii of curvature.)
double ContactSimulation::gapToBall(const Contact& contact, int mask, const Vector3d& m) const {
  const double radius = contact.tool.radius;
  const Vector3d now = displacementOf(mask);
  const auto gapAt = [&](const Vector3d& x) {
    const Vector3d from = x - contact.value;
    const double along = m.dot(from);
    const double across = (from + now - (along + m.dot(now)) * m).squaredNorm();
    return along - std::sqrt(std::max(radius * radius - across, 0.0));
  };
  const ContactMask& on = set_.mask(mask);
  double gap = 0;
  for (std::size_t k = 0; k < on.measureNodes.size(); ++k)
    gap += on.measure[k] * gapAt(surface_.mesh().nodes[on.measureNodes[k]]);
  if (mask != contact.firstMask) return gap;
  // A contact much narrower than its one mask.
  const double middle = gapAt(surface_.smoothPosition(on.point));
  const double offset = gap - middle, approach = -middle - m.dot(contact.lifted);
  if (approach <= 0 || offset <= 0) return offset > 0 ? middle : gap;
  const double part = std::sqrt(approach / (8 * offset));
  if (part >= kNarrowContact) return gap;
  return middle + 8 * offset * part * part * (1 - kNarrow * part);
}

/// What the laws demand of a contact's masks.
void ContactSimulation::demand(const Contact& contact) {
  for (int k = 0; k < contact.maskCount; ++k) {
    const int mask = contact.firstMask + k;
    ContactCondition& condition = conditions_[mask];
    condition = {};
    if (!set_.isPlaced(mask) || !set_.isReady(mask)) {
      condition.kind = ContactCondition::Kind::kForce;  // none
      continue;
    }
    condition.value = contact.value;
    if (contact.tool.kind == Kind::kForce) condition.kind = ContactCondition::Kind::kForce;
    if (!isPushing(contact.tool)) continue;
    condition.kind = ContactCondition::Kind::kUnilateral;
    condition.friction = contact.tool.friction;
    const SurfacePoint& point = set_.mask(mask).point;
    const Vector3d outward = surface_.normal(point);
    condition.normal = -outward;
    double closed = 0;
    if (contact.tool.kind == Kind::kProbe) {
      // Away from the ball's centre, seen from where the place is now.
      const Vector3d away = point.position + displacementOf(mask) - contact.value;
      if (away.dot(outward) < 0) condition.normal = away.normalized();
      closed = -gapToBall(contact, mask, condition.normal);
    } else {
      closed = condition.normal.dot(contact.value - surface_.smoothPosition(point));
    }
    // The gap, linear in d, along the normal; along the surface the slip against what sticks to the
    // tool.
    const Vector3d& m = condition.normal;
    const Vector3d stuck = contact.value - contact.reference;
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
  const Vector3d caused = contact.displacement - set_.freeDisplacements().segment<3>(3 * middle);
  const double squared = caused.squaredNorm();
  contact.stiffness = squared > 0 ? contact.force.dot(caused) / squared : 0.0;
  contact.status = !set_.isPlaced(middle)     ? Status::kHeld
                   : !set_.isReady(middle)    ? Status::kWaiting
                   : !isPushing(contact.tool) ? Status::kHolding
                   : !isPressing              ? Status::kOpen
                   : isSlipping               ? Status::kSlipping
                                              : Status::kSticking;
}

/// Moves the reference of a pushing tool by how much it slipped; returns the motion over the mask's
/// radius.
double ContactSimulation::slide(Contact& contact) {
  if (!isPushing(contact.tool)) return 0;
  Vector3d slip = Vector3d::Zero();
  double pressing = 0;
  for (int k = 0; k < contact.maskCount; ++k) {
    const int mask = contact.firstMask + k;
    if (forces_.statuses[mask] != ContactStatus::kSlipping) continue;
    const ContactCondition& condition = conditions_[mask];
    const double weight = forces_.forces.segment<3>(3 * mask).dot(condition.normal);
    const Vector3d off = displacementOf(mask) - condition.value;
    slip += weight * (off - condition.normal * condition.normal.dot(off));
    pressing += weight;
  }
  Vector3d next = contact.reference;
  if (pressing > 0) {
    next -= slip / pressing;
  } else if (contact.status != Status::kSticking) {
    // In the air, above the place that it would meet first.
    const Vector3d normal = surface_.normal(contact.point);
    const Vector3d moved = displacementOf(contact.firstMask);
    next = contact.value - (moved - normal * normal.dot(moved));
  }
  const double motion = (next - contact.reference).norm();
  contact.reference = next;
  return motion / std::max(contact.tool.radius, 1e-12);
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
