#include "bem/problem/rough_columns.h"

#include <utility>

namespace palpa::bem {

RoughColumns::RoughColumns(std::size_t nodeCount)
    : columnsOf_(std::make_unique<std::atomic<const float*>[]>(nodeCount)) {}

void RoughColumns::add(std::span<const int> nodes, Eigen::MatrixXf columns) {
  const int next = count_.load(std::memory_order_relaxed);
  blocks_[next] = std::move(columns);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    columnsOf_[nodes[k]].store(blocks_[next].col(3 * static_cast<Eigen::Index>(k)).data(),
                               std::memory_order_release);
  count_.store(next + 1, std::memory_order_release);
}

}  // namespace palpa::bem
