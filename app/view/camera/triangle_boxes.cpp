#include "app/view/triangle_boxes.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>

namespace palpa::view {
namespace {

// Large enough that few boxes are tried, small enough that few triangles are.
constexpr std::size_t kPerBox = 24;

/// The place on a curve through all cells of a grid of 1024³ (G. M. Morton, 1966) along which
/// neighbours are near to each other: the bits of the three numbers in turn.
std::uint32_t alongCurve(const Eigen::Vector3d& inUnitCube) {
  std::uint32_t place = 0;
  for (int k = 0; k < 3; ++k) {
    const auto cell = static_cast<std::uint32_t>(std::clamp(1024 * inUnitCube[k], 0.0, 1023.0));
    for (unsigned bit = 0; bit < 10; ++bit) {
      place |= ((cell >> bit) & 1U) << (3 * bit + static_cast<unsigned>(k));
    }
  }
  return place;
}

/// Whether the ray meets the box nearer than `farthest` (slabs between the pairs of sides).
bool meets(const Ray& ray, const Eigen::Array3d& inverse, const Bounds& box, double farthest) {
  const Eigen::Array3d a = (box.low - ray.origin).array() * inverse;
  const Eigen::Array3d b = (box.high - ray.origin).array() * inverse;
  // Not a number where the ray runs within a side: then that pair of sides does not decide.
  double enter = 0;
  double leave = farthest;
  for (int k = 0; k < 3; ++k) {
    const double first = std::min(a[k], b[k]);
    const double last = std::max(a[k], b[k]);
    if (first > enter) enter = first;
    if (last < leave) leave = last;
  }
  return enter <= leave;
}

}  // namespace

void TriangleBoxes::set(const std::vector<Eigen::Vector3d>& positions,
                        const std::vector<Triangle>& triangles) {
  Bounds all;
  for (const Eigen::Vector3d& position : positions) all.add(position);
  const double size = all.empty() ? 0 : all.size().maxCoeff();
  std::vector<std::uint32_t> places(triangles.size(), 0);
  for (std::size_t i = 0; i < triangles.size() && size > 0; ++i) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const int corner : triangles[i]) middle += positions[static_cast<std::size_t>(corner)] / 3;
    places[i] = alongCurve((middle - all.low) / size);
  }
  order_.resize(triangles.size());
  std::iota(order_.begin(), order_.end(), 0);
  std::stable_sort(order_.begin(), order_.end(), [&](int a, int b) {
    return places[static_cast<std::size_t>(a)] < places[static_cast<std::size_t>(b)];
  });
  isFitting_ = false;
}

void TriangleBoxes::fit(const std::vector<Eigen::Vector3d>& positions,
                        const std::vector<Triangle>& triangles) const {
  boxes_.assign((order_.size() + kPerBox - 1) / kPerBox, {});
  for (std::size_t i = 0; i < order_.size(); ++i) {
    for (const int corner : triangles[static_cast<std::size_t>(order_[i])]) {
      boxes_[i / kPerBox].add(positions[static_cast<std::size_t>(corner)]);
    }
  }
  // A little larger, as triangles are for a ray that runs between two of them.
  for (Bounds& box : boxes_) {
    const Eigen::Vector3d slack = Eigen::Vector3d::Constant(1e-9 * box.size().norm());
    box.low -= slack;
    box.high += slack;
  }
  isFitting_ = true;
}

std::optional<RayHit> TriangleBoxes::firstHit(const Ray& ray,
                                              const std::vector<Eigen::Vector3d>& positions,
                                              const std::vector<Triangle>& triangles) const {
  if (!isFitting_) fit(positions, triangles);
  std::optional<RayHit> first;
  const Eigen::Array3d inverse = ray.direction.array().inverse();
  for (std::size_t box = 0; box < boxes_.size(); ++box) {
    const double farthest = first ? first->distance : std::numeric_limits<double>::infinity();
    if (!meets(ray, inverse, boxes_[box], farthest)) continue;
    const std::size_t end = std::min(order_.size(), (box + 1) * kPerBox);
    for (std::size_t i = box * kPerBox; i < end; ++i) {
      const auto triangle = static_cast<std::size_t>(order_[i]);
      const auto distance = distanceTo(ray, positions, triangles[triangle]);
      if (distance && (!first || *distance < first->distance)) {
        first = RayHit{order_[i], *distance};
      }
    }
  }
  return first;
}

}  // namespace palpa::view
