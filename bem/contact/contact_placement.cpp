#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "bem/contact/contact_simulation.h"

// Geometry of ContactSimulation: positions of masks.

namespace palpa::bem {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Kind = ContactTool::Kind;

constexpr int kRings = 4;
constexpr int kLattice = 1 + 3 * kRings * (kRings + 1);
static_assert(kLattice == ContactTool::kBallMasks);
/// Radius of the lattice over the contact radius of two balls (H. Hertz).
constexpr double kMargin = 1.3;
/// Overlap of the lattice's masks: radius over spacing, where the spacing is at least the spacing
/// of the coefficients. The narrowest masks that the mesh can represent (1.25) would cover the
/// surface, but their effective width depends on their position among the nodes: their mean ρ^2
/// varies by up to a third, which the user feels.
constexpr double kOverlap = 1.7;
/// A lattice point is omitted if its distance from the surface point it projects to (beyond an edge
/// of the body) exceeds this fraction of the spacing.
constexpr double kFarthest = 0.6;
/// Height above the surface, over a mask's radius, from which surface points are searched.
constexpr double kLift = 0.2;
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

/// `direction` rotated by the smallest angle into the plane perpendicular to the unit normal.
Vector3d inPlane(const Vector3d& direction, const Vector3d& normal) {
  const Vector3d flat = direction - normal * normal.dot(direction);
  return flat.norm() > 1e-6 ? flat.normalized() : normal.unitOrthogonal();
}

}  // namespace

void ContactSimulation::placeMasks(Contact& contact) {
  if (contact.tool.presses()) {
    contact.point = footOf(contact);
    contact.across = inPlane(contact.across, surface_.normal(contact.point));
  }
  switch (contact.tool.kind) {
    case Kind::kGrab:
    case Kind::kForce:
      set_.place(contact.firstMask, contact.point, contact.tool.radius);
      break;
    case Kind::kPush:
      set_.place(contact.firstMask, placeOfPush(contact), contact.tool.radius);
      break;
    case Kind::kBall:
      placeBall(contact);
  }
}

/// A mask that waits stays, bit for bit, because one place is answered.
SurfacePoint ContactSimulation::placeOfPush(const Contact& contact) const {
  const int mask = contact.firstMask;
  return set_.isPlaced(mask) && !set_.isAvailable(mask) ? set_.mask(mask).point : contact.point;
}

/// Surface point below a tool's reference. The search starts slightly above the surface: seen from
/// outside a convex mesh the nearest point moves continuously, seen from inside it jumps from face
/// to face.
SurfacePoint ContactSimulation::footOf(const Contact& contact) const {
  const Vector3d normal = surface_.normal(contact.point);
  const Vector3d reference = contact.reference + contact.rolled;
  const double height = normal.dot(reference - contact.point.position);
  const double wanted = kLift * surface_.narrowestMask(contact.point);
  const Vector3d from = reference + std::max(wanted - height, 0.0) * normal;
  return surface_.foot(reference, surface_.tree().nearest(from));
}

/// Mean curvature of the surface around a contact, 1/mm, from normals at a distance (mm); positive
/// where the surface is convex. At most the curvature of a ball of this radius: an edge has no
/// curvature.
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
  return std::min(sum / 4, 1 / distance);
}

/// Places the masks of a ball. The contact lies within the region in which the surface without the
/// ball's force would penetrate the ball. The lattice is as fine as the mesh, or wide enough to
/// cover the contact.
void ContactSimulation::placeBall(Contact& contact) {
  const double radius = contact.tool.radius;
  const Vector3d normal = surface_.normal(contact.point);
  const Vector3d along = contact.across, across = normal.cross(along);
  const Vector3d ball = contact.value - contact.lifted;  // relative to the surface without it
  const double depth =
      std::clamp(radius - (ball - contact.point.position).dot(normal), 0.0, 2 * radius);
  const double finest = surface_.maskSpacing(contact.point);
  contact.curvature = 1 / radius + meanCurvature(contact, finest);
  const double reach = contact.curvature * radius * radius > depth
                           ? touchedRadius(depth, contact.curvature, contact.farCompliance)
                           : radius;
  const double spacing = std::max(finest, kMargin * reach / (kRings + 0.5));
  const Vector3d fromBall = contact.point.position - ball;
  const Vector2d beside(fromBall.dot(along), fromBall.dot(across));
  for (int k = 0; k < contact.maskCount; ++k) {
    const int mask = contact.firstMask + k;
    const Vector2d at = spacing * lattice()[k];
    // Most of a wide lattice is too far from the ball to need a search on the surface.
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

}  // namespace palpa::bem
