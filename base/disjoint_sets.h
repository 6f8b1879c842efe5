#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace palpa {

/// Division of the numbers 0 … size - 1 into sets, at first of one number each. Union-find with
/// path halving (Tarjan and van Leeuwen, Worst-case analysis of set union algorithms, 1984).
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size), count_(static_cast<int>(size)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  /// The smallest number of the set of a number.
  int rootOf(int number) {
    while (parent_[number] != number) number = parent_[number] = parent_[parent_[number]];
    return number;
  }
  /// Makes the sets of two numbers one; false if they were.
  bool join(int a, int b) {
    const int rootA = rootOf(a), rootB = rootOf(b);
    if (rootA == rootB) return false;
    parent_[std::max(rootA, rootB)] = std::min(rootA, rootB);
    --count_;
    return true;
  }
  /// Number of sets.
  int count() const { return count_; }

 private:
  std::vector<int> parent_;
  int count_;
};

}  // namespace palpa
