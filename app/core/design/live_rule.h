#pragma once

#include <optional>
#include <string>

#include "app/core/design/contact_stiffness.h"
#include "app/core/live/touch_snapshot.h"
#include "bem/contact/contact_surface.h"

namespace palpa::app {

/// stiffnessRuleOf() of a contact of the touch loop; none while it has no force. `surface`: of the
/// snapshot's model.
std::optional<StiffnessRule> liveRule(const TouchSnapshot& snapshot,
                                      const TouchSnapshot::Contact& contact,
                                      const bem::ContactSurface& surface, std::string name);

/// Limits of a change of a touch below which the gradient of its stiffness counts as the same: it
/// changes by a tenth of the largest gradient at most, at the points beside the touch (measured by
/// the test LiveGradient.HardlyChangesWithinTheLimits).
inline constexpr double kMaxPlaceChange = 0.03;  ///< of the radius
inline constexpr double kMaxTurn = 0.05;         ///< rad, of the direction

/// True if two rules describe about the same touch: the middle, the extent and the direction of
/// their forces differ by less than `share` of these limits. How far a touch is pulled does not
/// matter.
bool isSameTouch(const StiffnessRule& a, const StiffnessRule& b, double share = 1);

}  // namespace palpa::app
