#include <algorithm>
#include <cmath>
#include <numbers>

#include "bem/contact/contact_simulation.h"

// Contacts of balls in ContactSimulation: gaps, contacts narrower than a mask, and rotation of the
// surface.

namespace palpa::bem {
namespace {

using Eigen::Vector3d;

/// A mask of radius r on a half-space yields to a force F by c F / (E* r) (the mean under (1 - ρ^2
/// / r^2)^2).
constexpr double kMaskCompliance = 0.7665;
/// Contact narrower than its mask. A contact circle of radius a in a half-space yields by Hertz's
/// a^2 / R to F = 4/3 E* a^3 / R, R by the sum of curvatures; the body as a whole yields by C F in
/// addition, where C is the compliance of the mask minus c / (E* r). An approach A of the ball thus
/// makes a circle x = a / r with x^2 + g x^3 = A R / r^2, g = 4/3 C E* r. For this force the mask
/// must touch the ball after an approach of (x^2 - kNarrow x^3) r^2 / R with kNarrow = 4 c / 3.
/// This holds up to the larger x (kNarrowContact) at which this approach equals the mean gap r^2 /
/// 8 R of a fully pressed mask. There other masks begin to press.
constexpr double kNarrow = 4 * kMaskCompliance / 3, kNarrowContact = 0.77466, kWideContact = 1;

/// Share of the middle mask in the force of a ball: above the larger one the mask counts as alone,
/// below the smaller one as one of several.
constexpr double kSingleForce = 0.9, kSharedForce = 0.5;
/// Part of the way to the place found by a step that the masks go: where masks are switched on and
/// off on the way, the whole way would not settle.
constexpr double kRollShare = 0.3;

/// The smallest x > 0 with x^2 + g x^3 = p, p >= 0; without one (g < 0: a body stiffer than a
/// half-space), the x at which the left side is largest.
double circleOf(double p, double g) {
  constexpr int kMaxIterations = 60;
  const auto excess = [p, g](double x) { return x * x * (1 + g * x) - p; };
  if (g >= 0) {
    // Newton's method from above on a convex function.
    double x = std::sqrt(p);
    if (g * x > 1) x = std::cbrt(p / g);
    for (int k = 0; k < kMaxIterations && x > 0; ++k) {
      const double change = excess(x) / (x * (2 + 3 * g * x));
      x -= change;
      if (change <= 1e-14 * x) break;
    }
    return x;
  }
  double high = -2 / (3 * g);
  if (excess(high) <= 0) return high;
  double low = std::sqrt(p);
  for (int k = 0; k < kMaxIterations; ++k) {
    const double middle = (low + high) / 2;
    (excess(middle) < 0 ? low : high) = middle;
  }
  return low;
}

}  // namespace

/// Compliance of the body as a whole along `m` at a mask that is placed and ready, mm/N: of the
/// mask, minus the compliance of a half-space under it.
double ContactSimulation::farCompliance(int mask, const Vector3d& m) const {
  return m.dot(set_.compliance().block<3, 3>(3 * mask, 3 * mask) * m) -
         kMaskCompliance / (planeModulus_ * set_.mask(mask).radius);
}

/// Radius of the circle that a ball touches after an approach of `depth` (mm), by Hertz's law and
/// the compliance of the body as a whole (mm/N). `curvature`: of ball and surface together, 1/mm.
double ContactSimulation::touchedRadius(double depth, double curvature,
                                        double farCompliance) const {
  // The finest lattice decides where the body is stiffer than a half-space.
  const double g = std::max(4.0 / 3 * planeModulus_ * farCompliance, 0.0);
  return circleOf(depth / curvature, g);
}

/// Displacement of a mask along the unit vector `n` without the dip that the contact's own masks
/// press into a half-space, mm: the mean under a mask of radius r at the distance d from a force F
/// is F / (E* √((π d)^2 + (r / c)^2)) within a few per cent, exact for d = 0 and far away.
double ContactSimulation::displacementBesideDip(const Contact& contact, int mask,
                                                const Vector3d& n) const {
  double displacement = n.dot(displacementOf(mask));
  for (int other = contact.firstMask; other < contact.firstMask + contact.maskCount; ++other) {
    const double force = n.dot(forces_.forces.segment<3>(3 * other));
    if (force == 0) continue;
    const ContactMask& from = set_.mask(other);
    const double distance = (set_.mask(mask).point.position - from.point.position).norm();
    displacement -= force / (planeModulus_ * std::hypot(std::numbers::pi * distance,
                                                        from.radius / kMaskCompliance));
  }
  return displacement;
}

/// Slope of the normal displacement between opposite masks of the first ring, which turns the
/// surface below a ball; zero without enough masks.
Vector3d ContactSimulation::slopeBelow(const Contact& contact) const {
  const Vector3d normal = surface_.normal(contact.point);
  Eigen::Matrix3d directions = Eigen::Matrix3d::Zero();
  Vector3d slopes = Vector3d::Zero();
  int pairs = 0;
  for (int k = 1; k <= 3; ++k) {
    const int a = contact.firstMask + k, b = a + 3;
    if (!set_.isPlaced(a) || !set_.isPlaced(b) || !set_.isReady(a) || !set_.isReady(b)) continue;
    Vector3d along = set_.mask(a).point.position - set_.mask(b).point.position;
    along -= normal * normal.dot(along);
    directions += along * along.transpose();
    slopes += along * (displacementBesideDip(contact, a, normal) -
                       displacementBesideDip(contact, b, normal));
    ++pairs;
  }
  if (pairs < 2) return Vector3d::Zero();
  // The normal makes the matrix regular and has no part in the result.
  directions += directions.trace() * normal * normal.transpose();
  return directions.ldlt().solve(slopes);
}

/// Updates the place that a ball touches after the surface has turned: where one mask carries the
/// force, from the slope there; where several do, from the middle of their forces, as the dip that
/// they press is not known well enough on a coarse mesh. Returns how far it has moved, mm.
double ContactSimulation::roll(Contact& contact) const {
  const Vector3d normal = surface_.normal(contact.point);
  Vector3d middle = Vector3d::Zero();
  double sum = 0;
  for (const PatchForce& each : contact.patch) {
    const double pressing = std::max(-normal.dot(each.force), 0.0);
    sum += pressing;
    middle += pressing * (each.point.position - contact.point.position);
  }
  const double own =
      sum > 0 ? -normal.dot(forces_.forces.segment<3>(3 * contact.firstMask)) / sum : 1;
  const double bySlope = std::clamp((own - kSharedForce) / (kSingleForce - kSharedForce), 0.0, 1.0);
  const Vector3d fromSlope = contact.tool.radius * slopeBelow(contact);
  Vector3d next = fromSlope;
  if (bySlope < 1) {
    middle -= normal * normal.dot(middle);
    // A reference that moves by this much moves its foot on a curved surface to the middle.
    const Vector3d fromForces =
        contact.rolled + contact.tool.radius * std::max(contact.curvature, 0.0) / sum * middle;
    next = bySlope * fromSlope + (1 - bySlope) * fromForces;
  }
  Vector3d motion = kRollShare * (next - contact.rolled);
  // Beside an edge, neither the curvature nor the slope is reliable.
  const double most = set_.mask(contact.firstMask).radius;
  if (motion.norm() > most) motion *= most / motion.norm();
  contact.rolled += motion;
  return motion.norm();
}

/// Mean gap between a mask of the unloaded surface and a ball along the pressure direction `m`, mm:
/// ∫ b [m . (x - c) - √(R^2 - t^2)] dΓ with the bump b of the mask, where t is the distance across
/// m of the displaced surface from the centre c. The mean displacement of the mask must close this
/// gap. (The gap at the middle is smaller by the squared radius of the mask over 8 radii of
/// curvature.)
///
/// The bump of flat triangles has tails with small weights of either sign. They would cause waves
/// of the force while the ball slides; two measures prevent this. Where the ball is steeper than 45
/// degrees, it is replaced by the paraboloid that touches it there. A contact narrower than its
/// mask has the gap of a bump with exactly the mask's radius, by its ∫ Φ ρ^2 dΓ = r^2 / 4.
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
  // The contact is much narrower than its single mask.
  const double middle = gapAt(surface_.smoothPosition(on.point));
  const double all = gap - middle, approach = -middle - m.dot(contact.lifted);
  if (approach <= 0 || all <= 0) return all > 0 ? middle : gap;
  const double offset = all * on.radius * on.radius / (4 * spread);
  const double part = circleOf(approach / (8 * offset),
                               4.0 / 3 * planeModulus_ * on.radius * farCompliance(mask, m));
  if (part < kNarrowContact) return middle + 8 * offset * part * part * (1 - kNarrow * part);
  // From here, gradual transition to the true mean over the mask, as for all other masks.
  const double wide = std::min((part - kNarrowContact) / (kWideContact - kNarrowContact), 1.0);
  return middle + offset + wide * (all - offset);
}

}  // namespace palpa::bem
