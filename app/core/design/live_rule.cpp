#include "app/core/design/live_rule.h"

#include <cmath>

#include "app/core/live/touch_field.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;

/// Middle, extent and direction of the forces of a rule.
struct Summary {
  Vector3d middle = Vector3d::Zero();     // mm
  double extent = 0;                      // mm, root mean square distance from the middle
  Vector3d direction = Vector3d::Zero();  // unit; of the kept deflection, or of the force
  double radius = 0;                      // mm, of the masks
};

Summary summaryOf(const StiffnessRule& rule) {
  Summary summary;
  summary.radius = rule.masks.front().radius;
  if (rule.keepsDeflection()) {
    summary.middle = rule.masks.front().at;
    summary.direction = rule.deflection;
    return summary;
  }
  double total = 0;
  for (const StiffnessRule::Mask& mask : rule.masks) {
    summary.middle += mask.force.norm() * mask.at;
    summary.direction += mask.force;
    total += mask.force.norm();
  }
  summary.middle /= total;
  summary.direction.normalize();
  for (const StiffnessRule::Mask& mask : rule.masks)
    summary.extent += mask.force.norm() / total * (mask.at - summary.middle).squaredNorm();
  summary.extent = std::sqrt(summary.extent);
  return summary;
}

}  // namespace

std::optional<StiffnessRule> liveRule(const TouchSnapshot& snapshot,
                                      const TouchSnapshot::Contact& contact,
                                      const bem::ContactSurface& surface, std::string name) {
  if (!(contact.force.norm() > 0) || !(contact.deflection.norm() > 0)) return std::nullopt;
  TouchState::Contact at = contactOf(snapshot, contact, surface);
  at.name = std::move(name);
  return stiffnessRuleOf(at);
}

bool isSameTouch(const StiffnessRule& a, const StiffnessRule& b, double share) {
  if (a.keepsDeflection() != b.keepsDeflection()) return false;
  const Summary first = summaryOf(a), second = summaryOf(b);
  if (first.radius != second.radius) return false;
  const double most = share * kMaxPlaceChange * first.radius;
  // The opposite direction has the same stiffness.
  return (first.middle - second.middle).norm() <= most &&
         std::abs(first.extent - second.extent) <= most &&
         first.direction.cross(second.direction).norm() <= std::sin(share * kMaxTurn);
}

}  // namespace palpa::app
