#include "base/box_tree.h"

#include <numeric>

namespace palpa {

BoxTree::BoxTree(const std::vector<Box>& boxes, const std::vector<Vector3d>& centres)
    : order_(boxes.size()) {
  if (boxes.empty()) return;
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(2 * (boxes.size() / kLeafSize + 1) + 64);
  nodes_.push_back({Box(), 0, static_cast<int>(boxes.size()), -1});
  split(0, centres);
  refit(boxes);
}

void BoxTree::split(int index, const std::vector<Vector3d>& centres) {
  const int begin = nodes_[index].begin, end = nodes_[index].end;
  if (end - begin <= kLeafSize) return;
  Box extent;
  for (int k = begin; k < end; ++k) extent.extend(centres[order_[k]]);
  int axis = 0;
  extent.sizes().maxCoeff(&axis);
  const int middle = (begin + end) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](int a, int b) { return centres[a][axis] < centres[b][axis]; });
  const int left = static_cast<int>(nodes_.size());
  nodes_[index].left = left;
  nodes_.push_back({Box(), begin, middle, -1});
  nodes_.push_back({Box(), middle, end, -1});
  split(left, centres);
  split(left + 1, centres);
}

void BoxTree::refit(const std::vector<Box>& boxes) {
  // Children follow their parents.
  for (std::size_t n = nodes_.size(); n-- > 0;) {
    Node& node = nodes_[n];
    node.box.setEmpty();
    if (node.left < 0)
      for (int k = node.begin; k < node.end; ++k) node.box.extend(boxes[order_[k]]);
    else
      node.box.extend(nodes_[node.left].box).extend(nodes_[node.left + 1].box);
  }
}

std::vector<BoxTree::Box> triangleBoxes(const std::vector<Eigen::Vector3d>& positions,
                                        const std::vector<std::array<int, 3>>& triangles,
                                        double slack) {
  std::vector<BoxTree::Box> boxes;
  boxes.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) {
    BoxTree::Box box(positions[a]);
    box.extend(positions[b]).extend(positions[c]);
    if (slack > 0) {
      const Eigen::Vector3d margin = Eigen::Vector3d::Constant(slack * box.diagonal().norm());
      box = {box.min() - margin, box.max() + margin};
    }
    boxes.push_back(box);
  }
  return boxes;
}

BoxTree triangleTree(const std::vector<Eigen::Vector3d>& positions,
                     const std::vector<std::array<int, 3>>& triangles,
                     const std::vector<BoxTree::Box>& boxes) {
  constexpr double kThird = 1.0 / 3;
  std::vector<Eigen::Vector3d> centres;
  centres.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles)
    centres.push_back(kThird * positions[a] + kThird * positions[b] + kThird * positions[c]);
  return BoxTree(boxes, centres);
}

}  // namespace palpa
