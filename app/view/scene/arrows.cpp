#include "app/view/scene/arrows.h"

#include <algorithm>

namespace palpa::view {
namespace {

PlacedArrow place(const ForceArrow& arrow, double length) {
  const Eigen::Vector3d vector = length * arrow.force.normalized();
  if (arrow.anchor == ForceArrow::Anchor::kTail) return {arrow.at, arrow.at + vector, &arrow};
  return {arrow.at - vector, arrow.at, &arrow};
}

}  // namespace

const Eigen::Vector3d& PlacedArrow::freeEnd() const {
  return arrow->anchor == ForceArrow::Anchor::kTail ? tip : tail;
}

const Eigen::Vector3d& PlacedArrow::heldEnd() const {
  return arrow->anchor == ForceArrow::Anchor::kTail ? tail : tip;
}

std::vector<PlacedArrow> placeArrows(const LiveArrows& arrows, double longest) {
  // Far below a pixel there is no direction worth drawing.
  const double negligible = arrows.minShare > 0 ? 0 : 1e-3;
  std::vector<PlacedArrow> placed;
  for (const ForceArrow& arrow : arrows.arrows) {
    const double share = arrow.force.norm() / arrows.fullForce;
    if (share > negligible)
      placed.push_back(place(arrow, longest * std::clamp(share, arrows.minShare, 1.0)));
  }
  return placed;
}

}  // namespace palpa::view
