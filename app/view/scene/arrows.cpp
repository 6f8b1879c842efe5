#include "app/view/scene/arrows.h"

#include <Eigen/Geometry>
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
    const double force = arrow.force.norm();
    if (arrow.kind == ForceArrow::Kind::kMoment) {
      if (force > 0) placed.push_back(place(arrow, kMomentLength * longest));
      continue;
    }
    const double share = force / arrows.fullForce;
    if (share > negligible)
      placed.push_back(place(arrow, longest * std::clamp(share, arrows.minShare, 1.0)));
  }
  return placed;
}

double largestForce(const std::vector<ForceArrow>& arrows) {
  double largest = 0;
  for (const ForceArrow& arrow : arrows)
    if (arrow.kind != ForceArrow::Kind::kMoment) largest = std::max(largest, arrow.force.norm());
  return largest > 0 ? largest : 1;
}

Eigen::Vector3d volumeCentre(std::span<const Eigen::Vector3d> positions,
                             std::span<const Triangle> triangles) {
  if (triangles.empty()) return Eigen::Vector3d::Zero();
  // Tetrahedra from one corner of the surface to all triangles.
  const Eigen::Vector3d origin = positions[triangles.front()[0]];
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double volume = 0;
  for (const Triangle& triangle : triangles) {
    const Eigen::Vector3d a = positions[triangle[0]] - origin, b = positions[triangle[1]] - origin,
                          c = positions[triangle[2]] - origin;
    const double part = a.dot(b.cross(c));
    moment += part * (a + b + c) / 4;
    volume += part;
  }
  if (volume == 0) return origin;
  return origin + moment / volume;
}

}  // namespace palpa::view
