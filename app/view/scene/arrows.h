#pragma once

#include <span>
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
/// proportion below, but at least LiveArrows::minShare of that. Moments are kMomentLength of it
/// long.
std::vector<PlacedArrow> placeArrows(const LiveArrows& arrows, double longest);
inline constexpr double kMomentLength = 0.8;

/// The largest force; 1 without any, so that it can be LiveArrows::fullForce. Ignores moments.
double largestForce(const std::vector<ForceArrow>& arrows);

/// Centroid of the volume within a closed surface, where its weight acts.
Eigen::Vector3d volumeCentre(std::span<const Eigen::Vector3d> positions,
                             std::span<const Triangle> triangles);

}  // namespace palpa::view
