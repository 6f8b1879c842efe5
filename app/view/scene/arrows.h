#pragma once

#include <vector>

#include "app/view/scene/scene.h"

namespace palpa::view {

/// Ends of a force arrow.
struct PlacedArrow {
  Eigen::Vector3d tail;
  Eigen::Vector3d tip;
  const ForceArrow* arrow = nullptr;

  /// The end away from `arrow->at`, beside which the label stands.
  const Eigen::Vector3d& freeEnd() const;
  const Eigen::Vector3d& heldEnd() const;
};

/// Ends of all arrows with a force, `longest` (mm) long for LiveArrows::fullForce and more, in
/// proportion below, but at least LiveArrows::minShare of that.
std::vector<PlacedArrow> placeArrows(const LiveArrows& arrows, double longest);

}  // namespace palpa::view
