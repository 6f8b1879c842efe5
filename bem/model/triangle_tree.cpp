#include "bem/model/triangle_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace palpa::bem {
namespace {

using Eigen::Vector3d;

constexpr int kLeaf = 6;    // triangles
constexpr int kDepth = 64;  // of the tree at most: halving 2^64 triangles

}  // namespace

TriangleTree::TriangleTree(const BoundaryMesh& mesh) : mesh_(mesh) {
  const int count = mesh.triangleCount();
  order_.resize(count);
  std::iota(order_.begin(), order_.end(), 0);
  middles_.reserve(count);
  for (int t = 0; t < count; ++t) middles_.push_back(mesh.point(t, Vector3d::Constant(1.0 / 3)));
  boxes_.reserve(2 * (count / kLeaf + 1) + 64);
  boxes_.emplace_back();
  if (count > 0) split(0, 0, count);
  middles_ = {};
}

void TriangleTree::split(int box, int first, int last) {
  Eigen::AlignedBox3d bounds, middles;
  for (int k = first; k < last; ++k) {
    for (const int node : mesh_.triangles[order_[k]]) bounds.extend(mesh_.nodes[node]);
    middles.extend(middles_[order_[k]]);
  }
  boxes_[box].bounds = bounds;
  if (last - first <= kLeaf) {
    boxes_[box].first = first;
    boxes_[box].count = last - first;
    return;
  }
  int axis = 0;
  middles.sizes().maxCoeff(&axis);
  const int middle = (first + last) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](int a, int b) { return middles_[a][axis] < middles_[b][axis]; });
  const int left = static_cast<int>(boxes_.size());
  boxes_[box].first = left;
  boxes_.resize(boxes_.size() + 2);
  split(left, first, middle);
  split(left + 1, middle, last);
}

SurfacePoint TriangleTree::nearest(const Vector3d& point) const {
  SurfacePoint best{-1, Vector3d::Zero(), Vector3d::Zero(),
                    std::numeric_limits<double>::infinity()};
  std::array<int, kDepth> open;
  int size = 0;
  open[size++] = 0;
  while (size > 0) {
    const Box& box = boxes_[open[--size]];
    if (box.bounds.exteriorDistance(point) >= best.distance) continue;
    if (box.count > 0) {
      for (int k = box.first; k < box.first + box.count; ++k) {
        const SurfacePoint found = nearestOnTriangle(mesh_, order_[k], point);
        if (found.distance < best.distance) best = found;
      }
      continue;
    }
    // The nearer child is looked at first.
    const bool leftFirst = boxes_[box.first].bounds.squaredExteriorDistance(point) <=
                           boxes_[box.first + 1].bounds.squaredExteriorDistance(point);
    open[size++] = leftFirst ? box.first + 1 : box.first;
    open[size++] = leftFirst ? box.first : box.first + 1;
  }
  return best;
}

TriangleTree::Hit TriangleTree::firstHit(const Vector3d& origin, const Vector3d& direction) const {
  Hit best;
  best.distance = std::numeric_limits<double>::infinity();
  const Vector3d inverse = direction.cwiseInverse();
  // Where the ray is inside a box (slab test); NaN of 0 * infinity counts as inside.
  const auto meets = [&](const Eigen::AlignedBox3d& box) {
    double enter = 0, leave = best.distance;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (box.min()[axis] - origin[axis]) * inverse[axis];
      const double b = (box.max()[axis] - origin[axis]) * inverse[axis];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    return !(enter > leave);
  };
  std::array<int, kDepth> open;
  int size = 0;
  open[size++] = 0;
  while (size > 0) {
    const Box& box = boxes_[open[--size]];
    if (!meets(box.bounds)) continue;
    if (box.count == 0) {
      open[size++] = box.first;
      open[size++] = box.first + 1;
      continue;
    }
    for (int k = box.first; k < box.first + box.count; ++k) {
      // Möller & Trumbore, Fast, minimum storage ray/triangle intersection, J. Graphics Tools 2
      // (1997) 21-28.
      const auto& c = mesh_.triangles[order_[k]];
      const Vector3d ab = mesh_.nodes[c[1]] - mesh_.nodes[c[0]];
      const Vector3d ac = mesh_.nodes[c[2]] - mesh_.nodes[c[0]];
      const Vector3d across = direction.cross(ac);
      const double determinant = ab.dot(across);
      if (determinant == 0) continue;
      const Vector3d from = origin - mesh_.nodes[c[0]];
      const double u = from.dot(across) / determinant;
      const Vector3d q = from.cross(ab);
      const double v = direction.dot(q) / determinant;
      const double s = ac.dot(q) / determinant;
      if (u < 0 || v < 0 || u + v > 1 || s < 0 || s >= best.distance) continue;
      best = {order_[k], s, {1 - u - v, u, v}};
    }
  }
  return best;
}

}  // namespace palpa::bem
