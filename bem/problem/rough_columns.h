#pragma once

#include <Eigen/Dense>
#include <array>
#include <atomic>
#include <memory>
#include <span>

namespace palpa::bem {

/// Blocks of rough columns (ReferenceProblem::hasRoughSolution()) of some nodes, three columns
/// each, which are read until better ones are known. One thread at a time adds, any number of
/// threads read without locks: blocks are kept until the model ends.
class RoughColumns {
 public:
  /// `nodeCount`: nodes that may get columns, numbered from zero.
  explicit RoughColumns(std::size_t nodeCount);

  /// The columns along x, y, z of a node, one after another; null if there are none.
  const float* find(int node) const { return columnsOf_[node].load(std::memory_order_acquire); }
  /// Adds columns 3 k, 3 k + 1, 3 k + 2 of each nodes[k]. There must be room.
  void add(std::span<const int> nodes, Eigen::MatrixXf columns);
  bool isFull() const { return count() == kMaxBlocks; }
  /// Number of blocks.
  int count() const { return count_.load(std::memory_order_acquire); }

  static constexpr int kMaxBlocks = 64;

 private:
  std::array<Eigen::MatrixXf, kMaxBlocks> blocks_;
  std::atomic<int> count_{0};
  std::unique_ptr<std::atomic<const float*>[]> columnsOf_;  ///< per node
};

}  // namespace palpa::bem
