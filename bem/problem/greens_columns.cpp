#include "bem/problem/greens_columns.h"

#include <algorithm>
#include <new>

namespace palpa::bem {

GreensColumns::GreensColumns(std::shared_ptr<const ReferenceProblem> problem)
    : problem_(std::move(problem)),
      rows_(problem_->dofs().count()),
      indexOfNode_(problem_->dofs().nodeCount(), -1) {
  const DegreesOfFreedom& dofs = problem_->dofs();
  for (int node = 0; node < dofs.nodeCount(); ++node) {
    if (!dofs.isFree(node)) continue;
    indexOfNode_[node] = static_cast<int>(nodes_.size());
    nodes_.push_back(node);
  }
  isReady_ = std::make_unique<std::atomic<unsigned char>[]>(nodes_.size());
  try {
    columns_ = LargeMatrix<float>(rows_, 3 * static_cast<Eigen::Index>(nodes_.size()));
  } catch (const std::bad_alloc&) {
    throw SolverError(
        SolverError::Kind::kTooLarge,
        "there is too little memory for the Green's function; choose a larger edge length");
  }
}

bool GreensColumns::hasAll(std::span<const int> nodes) const {
  return std::all_of(nodes.begin(), nodes.end(), [this](int node) { return has(node); });
}

void GreensColumns::compute(std::span<const int> nodes, const Job& job,
                            ReferenceProblem::Effort effort) {
  std::vector<int> missing;
  std::vector<bool> isListed(indexOfNode_.size(), false);
  for (const int node : nodes) {
    if (indexOfNode_[node] < 0 || isListed[node] || has(node)) continue;
    missing.push_back(node);
    isListed[node] = true;
  }
  std::vector<int> dofs;
  for (std::size_t first = 0; first < missing.size(); first += kBlock) {
    job.throwIfCancelled();
    const std::size_t last = std::min(missing.size(), first + kBlock);
    dofs.clear();
    // BLAS treats the last columns of a block differently if their number is odd.
    for (std::size_t k = first; k < first + kBlock; ++k)
      for (int axis = 0; axis < 3; ++axis)
        dofs.push_back(3 * missing[std::min(k, last - 1)] + axis);
    const Eigen::MatrixXd block = problem_->greensColumns(dofs, effort, job);
    for (std::size_t k = first; k < last; ++k) {
      const int index = indexOfNode_[missing[k]];
      columns_.view().middleCols<3>(3 * static_cast<Eigen::Index>(index)) =
          block.middleCols<3>(3 * static_cast<Eigen::Index>(k - first)).cast<float>();
      if (isReady_[index].exchange(1, std::memory_order_release) == 0)
        readyCount_.fetch_add(1, std::memory_order_release);
    }
    job.report(Phase::kGreensFunction,
               static_cast<double>(last) / static_cast<double>(missing.size()));
  }
}

std::vector<int> GreensColumns::nodesNear(const std::vector<Eigen::Vector3d>& places,
                                          const Eigen::Vector3d& point) const {
  std::vector<int> order = nodes_;
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return (places[a] - point).squaredNorm() < (places[b] - point).squaredNorm();
  });
  return order;
}

}  // namespace palpa::bem
