#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "bem/contact/contact_simulation.h"

// Where masks are, and how far from a ball: what ContactSimulation knows of geometry.

namespace palpa::bem {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Kind = ContactTool::Kind;

constexpr int kRings = 4;
constexpr int kLattice = 1 + 3 * kRings * (kRings + 1);
static_assert(kLattice == ContactSimulation::kProbeMasks);
/// The lattice reaches this much farther than the contact between two balls would (H. Hertz).
constexpr double kMargin = 1.3;
/// Masks of the lattice overlap: radius over spacing, where the spacing is at least that of the
/// coefficients. The narrowest that the mesh can carry (1.25) would do, but how wide these are in
/// effect depends on where they lie among the nodes: by up to a third of their mean ρ^2, which is
/// felt.
constexpr double kOverlap = 1.7;
/// A lattice point that lies farther than this part of the spacing from the surface point it falls
/// on (beyond an edge of the body) is left out.
constexpr double kFarthest = 0.6;
/// Places are looked for from this part of a mask's radius above the surface.
constexpr double kLift = 0.2;
/// A mask of radius r on a half-space yields to the force F of a ball by c F / (E* r), c =
/// 0.7665 (the mean under (1 - ρ^2 / r^2)^2), a circle of contact a by Hertz's a^2 / R with F = 4/3
/// E* a^3 / R. So a mask that stands for a circle x = a / r must meet the ball when that has come
/// nearer by (x^2 - kNarrow x^3) r^2 / R with kNarrow = 4 c / 3; up to the larger x at which this
/// is the mean gap r^2 / 8 R of a mask that is pressed all over. Other masks begin to press there.
constexpr double kNarrow = 1.022, kNarrowContact = 0.77466, kWideContact = 1;

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

/// `direction` turned as little as needed to lie in the plane across the unit normal.
Vector3d inPlane(const Vector3d& direction, const Vector3d& normal) {
  const Vector3d flat = direction - normal * normal.dot(direction);
  return flat.norm() > 1e-6 ? flat.normalized() : normal.unitOrthogonal();
}

}  // namespace

void ContactSimulation::placeMasks(Contact& contact) {
  if (!contact.tool.isPushing()) {
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
  return surface_.foot(contact.reference, surface_.tree().nearest(from));
}

/// Of the surface around a contact, from normals at a distance (mm); positive where it bulges.
double ContactSimulation::meanCurvature(const Contact& contact, double distance) const {
  const Vector3d normal = surface_.normal(contact.point);
  const Vector3d across = normal.cross(contact.across);
  double sum = 0;
  for (const Vector3d& direction :
       {contact.across, Vector3d(-contact.across), across, Vector3d(-across)}) {
    const SurfacePoint point =
        surface_.nearest(contact.point.position + distance * direction + kLift * distance * normal);
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
  const double finest = surface_.maskSpacing(contact.point);
  const double curvature = 1 / radius + meanCurvature(contact, finest);
  const double reach = curvature * radius * radius > depth ? std::sqrt(depth / curvature) : radius;
  const double spacing = std::max(finest, kMargin * reach / (kRings + 0.5));
  const Vector3d fromBall = contact.point.position - ball;
  const Vector2d beside(fromBall.dot(along), fromBall.dot(across));
  for (int k = 0; k < contact.maskCount; ++k) {
    const int mask = contact.firstMask + k;
    const Vector2d at = spacing * lattice()[k];
    // Most of a wide lattice is so far from the ball that the surface need not be looked at.
    if (k > 0 && (beside + at).norm() >= radius + kFarthest * spacing) {
      set_.clear(mask);
      continue;
    }
    const Vector3d wanted =
        contact.point.position + at[0] * along + at[1] * across + kLift * spacing * normal;
    const SurfacePoint point =
        k == 0 ? contact.point : surface_.facing(surface_.nearest(wanted), normal);
    const Vector3d off = point.position - wanted;
    const double aside = (off - normal * normal.dot(off)).norm();
    const bool isInside = (point.position - ball).norm() < radius || k == 0;
    if (isInside && aside <= kFarthest * spacing)
      set_.place(mask, point, kOverlap * spacing);
    else
      set_.clear(mask);
  }
}

/// How far a mask of the unloaded surface is from a ball along the direction `m` of its pressure,
/// in the mean: ∫ Φ [m . (x - c) - √(R^2 - t^2)] dΓ with t what lies across m, for which the
/// surface is taken where it is now. That is what the mask's mean displacement must make up for.
/// (At the middle alone the gap would be smaller by the mask's radius squared over 8 radii of
/// curvature.)
///
/// A projected bump has tails with small weights of either sign. Two things keep them from being
/// felt as waves of the force while the ball slides: where it is steeper than 45 degrees the ball
/// goes on as the paraboloid that touches it there; and a contact narrower than its mask meets what
/// a bump of exactly the mask's radius would, by its ∫ Φ ρ^2 dΓ = r^2 / 4.
double ContactSimulation::gapToBall(const Contact& contact, int mask, const Vector3d& m) const {
  const double radius = contact.tool.radius, square = radius * radius;
  const Vector3d now = displacementOf(mask);
  const auto gapAt = [&](const Vector3d& x) {
    const Vector3d from = x - contact.value;
    const double along = m.dot(from);
    const double across = (from + now - (along + m.dot(now)) * m).squaredNorm();
    const double height = across < square / 2
                              ? std::sqrt(square - across)
                              : (1.5 * square - across) / (std::numbers::sqrt2 * radius);
    return along - height;
  };
  const ContactMask& on = set_.mask(mask);
  double gap = 0, spread = 0;
  for (std::size_t k = 0; k < on.points.size(); ++k) {
    gap += on.pointWeights[k] * gapAt(on.points[k]);
    spread += on.pointWeights[k] * (on.points[k] - on.point.position).squaredNorm();
  }
  if (mask != contact.firstMask) return gap;
  // A contact much narrower than its one mask.
  const double middle = gapAt(surface_.smoothPosition(on.point));
  const double all = gap - middle, approach = -middle - m.dot(contact.lifted);
  if (approach <= 0 || all <= 0) return all > 0 ? middle : gap;
  const double offset = all * on.radius * on.radius / (4 * spread);
  const double part = std::sqrt(approach / (8 * offset));
  if (part < kNarrowContact) return middle + 8 * offset * part * part * (1 - kNarrow * part);
  // From there on, gradually, the mean over the mask as it is, as over all others.
  const double wide = std::min((part - kNarrowContact) / (kWideContact - kNarrowContact), 1.0);
  return middle + offset + wide * (all - offset);
}

}  // namespace palpa::bem
