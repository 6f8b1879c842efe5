#include "app/view/camera/triangle_boxes.h"

#include <limits>

namespace palpa::view {
namespace {

// Boxes are larger than their triangles by more than the slack of distanceTo().
constexpr double kSlack = 1e-9;

}  // namespace

void TriangleBoxes::set(const std::vector<Eigen::Vector3d>& positions,
                        const std::vector<Triangle>& triangles) {
  tree_ = triangleTree(positions, triangles, triangleBoxes(positions, triangles, kSlack));
  isFitting_ = true;
}

std::optional<RayHit> TriangleBoxes::firstHit(const Ray& ray,
                                              const std::vector<Eigen::Vector3d>& positions,
                                              const std::vector<Triangle>& triangles) const {
  if (!isFitting_) tree_.refit(triangleBoxes(positions, triangles, kSlack));
  isFitting_ = true;
  std::optional<RayHit> first;
  tree_.visitAlong(ray.origin, ray.direction, std::numeric_limits<double>::infinity(),
                   [&](int triangle, double reach) {
                     const auto distance =
                         distanceTo(ray, positions, triangles[static_cast<std::size_t>(triangle)]);
                     if (!distance || *distance >= reach) return reach;
                     first = RayHit{triangle, *distance};
                     return *distance;
                   });
  return first;
}

}  // namespace palpa::view
