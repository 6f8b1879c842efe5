#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace palpa::modeling {

/// Binary tree of axis-parallel boxes around triangles, to find the pairs whose boxes meet.
class TriangleBoxes {
 public:
  TriangleBoxes(const std::vector<Eigen::Vector3d>& positions,
                const std::vector<std::array<int, 3>>& triangles)
      : order_(triangles.size()) {
    for (const auto& [a, b, c] : triangles) {
      Box box(positions[a]);
      box.extend(positions[b]).extend(positions[c]);
      boxes_.push_back(box);
    }
    std::iota(order_.begin(), order_.end(), 0);
    if (!order_.empty()) build(0, static_cast<int>(order_.size()));
  }

  /// Calls visit(a, b), a < b, for every pair of triangles whose boxes meet, each pair once, until
  /// it returns false.
  template <class Visit>
  void forPairs(const Visit& visit) const {
    if (!nodes_.empty()) within(0, visit);
  }

 private:
  using Box = Eigen::AlignedBox3d;

  static constexpr int kLeaf = 4;

  struct Node {
    Box box;
    int begin = 0, end = 0;     // range of order_
    int left = -1, right = -1;  // -1 in a leaf
  };

  int build(int begin, int end) {
    const int index = static_cast<int>(nodes_.size());
    nodes_.push_back({Box(), begin, end, -1, -1});
    Box box;
    for (int i = begin; i < end; ++i) box.extend(boxes_[order_[i]]);
    nodes_[index].box = box;
    if (end - begin <= kLeaf) return index;
    Eigen::Index axis = 0;
    box.sizes().maxCoeff(&axis);
    const int middle = (begin + end) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](int a, int b) {
                       const double x = boxes_[a].center()[axis];
                       const double y = boxes_[b].center()[axis];
                       return x != y ? x < y : a < b;
                     });
    const int left = build(begin, middle);
    const int right = build(middle, end);
    nodes_[index].left = left;
    nodes_[index].right = right;
    return index;
  }

  template <class Visit>
  bool within(int n, const Visit& visit) const {
    const Node& node = nodes_[n];
    if (node.left >= 0)
      return within(node.left, visit) && within(node.right, visit) &&
             between(node.left, node.right, visit);
    for (int i = node.begin; i < node.end; ++i)
      for (int j = i + 1; j < node.end; ++j)
        if (!visitPair(order_[i], order_[j], visit)) return false;
    return true;
  }

  template <class Visit>
  bool between(int m, int n, const Visit& visit) const {
    const Node& first = nodes_[m];
    const Node& second = nodes_[n];
    if (!first.box.intersects(second.box)) return true;
    if (first.left < 0 && second.left < 0) {
      for (int i = first.begin; i < first.end; ++i)
        for (int j = second.begin; j < second.end; ++j)
          if (!visitPair(order_[i], order_[j], visit)) return false;
      return true;
    }
    const bool splitFirst = second.left < 0 || (first.left >= 0 && first.end - first.begin >=
                                                                       second.end - second.begin);
    if (splitFirst) return between(first.left, n, visit) && between(first.right, n, visit);
    return between(m, second.left, visit) && between(m, second.right, visit);
  }

  template <class Visit>
  bool visitPair(int a, int b, const Visit& visit) const {
    return !boxes_[a].intersects(boxes_[b]) || visit(std::min(a, b), std::max(a, b));
  }

  std::vector<Box> boxes_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace palpa::modeling
