#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace palpa {

/// Binary tree of axis-parallel boxes around numbered items (triangles, segments), in any unit of
/// length. The tree knows only boxes: callers pass a function that looks at an item. Const use from
/// several threads is safe; no query allocates. Memory: about 30 bytes per item.
class BoxTree {
 public:
  using Box = Eigen::AlignedBox3d;
  using Vector3d = Eigen::Vector3d;

  BoxTree() = default;
  /// Item k has the box `boxes[k]`; items are divided by their `centres`. Time: n log n, about 5 ms
  /// for 20,000 items.
  BoxTree(const std::vector<Box>& boxes, const std::vector<Vector3d>& centres);

  /// Adapts the tree to other boxes of the same items, which it then finds more slowly the more
  /// they have moved.
  void refit(const std::vector<Box>& boxes);

  /// Calls reach = visit(item, reach) for the items whose boxes are nearer to the point than
  /// `reach`, nearer boxes first. For the nearest item `visit` returns the smallest distance so
  /// far.
  template <class Visit>
  void visitNear(const Vector3d& point, double reach, const Visit& visit) const {
    if (nodes_.empty()) return;
    std::array<int, kMaxDepth> open;
    int size = 0;
    open[size++] = 0;
    while (size > 0) {
      const Node& node = nodes_[open[--size]];
      if (node.box.exteriorDistance(point) >= reach) continue;
      if (node.left < 0) {
        for (int k = node.begin; k < node.end; ++k) reach = visit(order_[k], reach);
        continue;
      }
      const bool leftFirst = nodes_[node.left].box.squaredExteriorDistance(point) <=
                             nodes_[node.left + 1].box.squaredExteriorDistance(point);
      open[size++] = leftFirst ? node.left + 1 : node.left;
      open[size++] = leftFirst ? node.left : node.left + 1;
    }
  }

  /// Calls reach = visit(item, reach) for the items whose boxes meet the points
  /// origin + s direction, 0 <= s <= reach. For the first hit `visit` returns the smallest s so
  /// far.
  template <class Visit>
  void visitAlong(const Vector3d& origin, const Vector3d& direction, double reach,
                  const Visit& visit) const {
    if (nodes_.empty()) return;
    const Vector3d inverse = direction.cwiseInverse();
    std::array<int, kMaxDepth> open;
    int size = 0;
    open[size++] = 0;
    while (size > 0) {
      const Node& node = nodes_[open[--size]];
      if (!meets(node.box, origin, inverse, reach)) continue;
      if (node.left < 0) {
        for (int k = node.begin; k < node.end; ++k) reach = visit(order_[k], reach);
        continue;
      }
      open[size++] = node.left;
      open[size++] = node.left + 1;
    }
  }

  /// Calls visit(a, b), a < b, once for every pair of items with overlapping boxes, until it
  /// returns false. `boxes`: as given to the constructor or refit().
  template <class Visit>
  void visitOverlaps(const std::vector<Box>& boxes, const Visit& visit) const {
    if (!nodes_.empty()) within(boxes, nodes_.front(), visit);
  }

 private:
  static constexpr int kLeafSize = 6;
  static constexpr int kMaxDepth = 64;  // halving 2^64 items

  struct Node {
    Box box;
    int begin = 0, end = 0;  // range of order_
    int left = -1;           // the right child follows; -1 in a leaf
  };

  void split(int index, const std::vector<Vector3d>& centres);

  /// True if the ray passes through the box before `reach` (slab test). A ray within the plane of
  /// a side gives 0 * infinity; then this pair of sides does not decide.
  static bool meets(const Box& box, const Vector3d& origin, const Vector3d& inverse, double reach) {
    double enter = 0, leave = reach;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (box.min()[axis] - origin[axis]) * inverse[axis];
      const double b = (box.max()[axis] - origin[axis]) * inverse[axis];
      if (std::isnan(a) || std::isnan(b)) continue;
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
  }

  template <class Visit>
  bool within(const std::vector<Box>& boxes, const Node& node, const Visit& visit) const {
    if (node.left >= 0) {
      const Node &left = nodes_[node.left], &right = nodes_[node.left + 1];
      return within(boxes, left, visit) && within(boxes, right, visit) &&
             between(boxes, left, right, visit);
    }
    for (int i = node.begin; i < node.end; ++i)
      for (int j = i + 1; j < node.end; ++j)
        if (!visitPair(boxes, order_[i], order_[j], visit)) return false;
    return true;
  }

  template <class Visit>
  bool between(const std::vector<Box>& boxes, const Node& first, const Node& second,
               const Visit& visit) const {
    if (!first.box.intersects(second.box)) return true;
    if (first.left < 0 && second.left < 0) {
      for (int i = first.begin; i < first.end; ++i)
        for (int j = second.begin; j < second.end; ++j)
          if (!visitPair(boxes, order_[i], order_[j], visit)) return false;
      return true;
    }
    const bool splitsFirst = second.left < 0 || (first.left >= 0 && first.end - first.begin >=
                                                                        second.end - second.begin);
    if (splitsFirst)
      return between(boxes, nodes_[first.left], second, visit) &&
             between(boxes, nodes_[first.left + 1], second, visit);
    return between(boxes, first, nodes_[second.left], visit) &&
           between(boxes, first, nodes_[second.left + 1], visit);
  }

  template <class Visit>
  static bool visitPair(const std::vector<Box>& boxes, int a, int b, const Visit& visit) {
    return !boxes[a].intersects(boxes[b]) || visit(std::min(a, b), std::max(a, b));
  }

  std::vector<int> order_;  // the items, contiguous for each node
  std::vector<Node> nodes_;
};

/// The boxes of triangles; `slack` enlarges each by this part of its diagonal.
std::vector<BoxTree::Box> triangleBoxes(const std::vector<Eigen::Vector3d>& positions,
                                        const std::vector<std::array<int, 3>>& triangles,
                                        double slack = 0);

/// The tree of triangles with these boxes, divided by their centroids.
BoxTree triangleTree(const std::vector<Eigen::Vector3d>& positions,
                     const std::vector<std::array<int, 3>>& triangles,
                     const std::vector<BoxTree::Box>& boxes);

}  // namespace palpa
