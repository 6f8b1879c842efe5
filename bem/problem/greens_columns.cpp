#include "bem/problem/greens_columns.h"

#include <algorithm>
#include <limits>
#include <new>

namespace palpa::bem {

using Eigen::MatrixXd;
using Eigen::Vector3d;

GreensColumns::GreensColumns(std::shared_ptr<const ReferenceProblem> problem)
    : problem_(std::move(problem)),
      rows_(problem_->dofs().count()),
      indexOfNode_(problem_->dofs().nodeCount(), -1),
      rough_(static_cast<std::size_t>(problem_->dofs().nodeCount())) {
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

bool GreensColumns::hasAllRough(std::span<const int> nodes) const {
  return std::all_of(nodes.begin(), nodes.end(), [this](int node) { return hasRough(node); });
}

std::unique_lock<StoppableMutex> GreensColumns::waitForTurn(const Job& job) {
  job.throwIfCancelled();
  computing_.lock(job.stop);
  return std::unique_lock(computing_, std::adopt_lock);
}

void GreensColumns::take(const KnownColumns& known) {
  const std::lock_guard lock(computing_);
  for (std::size_t k = 0; k < known.nodes.size(); ++k) {
    const int index = indexOfNode_[known.nodes[k]];
    if (index < 0 || has(known.nodes[k])) continue;
    columns_.view().middleCols<3>(3 * static_cast<Eigen::Index>(index)) =
        known.values.middleCols<3>(3 * static_cast<Eigen::Index>(k));
    isReady_[index].store(1, std::memory_order_release);
    readyCount_.fetch_add(1, std::memory_order_release);
  }
}

KnownColumns GreensColumns::copyOf(std::span<const int> nodes) const {
  KnownColumns known;
  for (const int node : nodes)
    if (has(node)) known.nodes.push_back(node);
  known.values.resize(rows_, 3 * static_cast<Eigen::Index>(known.nodes.size()));
  for (std::size_t k = 0; k < known.nodes.size(); ++k)
    for (int axis = 0; axis < 3; ++axis)
      known.values.col(3 * static_cast<Eigen::Index>(k) + axis) =
          Eigen::Map<const Eigen::VectorXf>(column(known.nodes[k], axis), rows_);
  return known;
}

MatrixXd GreensColumns::solveBlock(std::span<const int> nodes, ReferenceProblem::Effort effort,
                                   const Job& job) const {
  std::vector<int> dofs;
  // BLAS treats the last columns of a block differently if their number is odd.
  for (std::size_t k = 0; k < kBlock; ++k)
    for (int axis = 0; axis < 3; ++axis)
      dofs.push_back(3 * nodes[std::min(k, nodes.size() - 1)] + axis);
  return problem_->greensColumns(dofs, effort, job);
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
  for (std::size_t first = 0; first < missing.size(); first += kBlock) {
    const auto turn = waitForTurn(job);
    const std::size_t last = std::min(missing.size(), first + kBlock);
    const std::span<const int> block(missing.data() + first, last - first);
    if (hasAll(block)) continue;  // another thread has computed them
    const MatrixXd columns = solveBlock(block, effort, job);
    for (std::size_t k = 0; k < block.size(); ++k) {
      if (has(block[k])) continue;  // in use; the same numbers
      const int index = indexOfNode_[block[k]];
      columns_.view().middleCols<3>(3 * static_cast<Eigen::Index>(index)) =
          columns.middleCols<3>(3 * static_cast<Eigen::Index>(k)).cast<float>();
      isReady_[index].store(1, std::memory_order_release);
      readyCount_.fetch_add(1, std::memory_order_release);
    }
    job.report(Phase::kGreensFunction,
               static_cast<double>(last) / static_cast<double>(missing.size()));
  }
}

void GreensColumns::computeRough(std::span<const int> nodes, const Job& job) {
  const auto turn = waitForTurn(job);
  std::vector<int> missing;
  for (const int node : nodes)
    if (indexOfNode_[node] >= 0 && !hasRough(node)) missing.push_back(node);
  for (std::size_t first = 0; first < missing.size() && takesRough(); first += kBlock) {
    const auto block =
        std::span(missing).subspan(first, std::min<std::size_t>(missing.size() - first, kBlock));
    std::vector<int> indices;
    for (const int node : block) indices.push_back(indexOfNode_[node]);
    rough_.add(indices, solveBlock(block, ReferenceProblem::Effort::kRough, job).cast<float>());
  }
}

void GreensColumns::computeAround(std::span<const int> nodes, const std::vector<Vector3d>& places,
                                  const Job& job) {
  std::vector<int> block;
  std::vector<Vector3d> points;
  for (const int node : nodes) {
    if (indexOfNode_[node] < 0 || has(node) ||
        std::find(block.begin(), block.end(), node) != block.end())
      continue;
    block.push_back(node);
    points.push_back(places[node]);
  }
  if (block.empty()) return;
  fillBlock(block, places, points);
  compute(block, job);
}

void GreensColumns::fillBlock(std::vector<int>& nodes, const std::vector<Vector3d>& places,
                              const std::vector<Vector3d>& points, bool isRough) const {
  const std::size_t blocks = std::max<std::size_t>((nodes.size() + kBlock - 1) / kBlock, 1);
  const std::size_t wanted = kBlock * blocks - nodes.size();
  if (wanted == 0) return;
  struct Candidate {
    double distance;
    int node;
  };
  std::vector<Candidate> others;
  for (const int node : nodes_) {
    if (has(node, isRough) || std::find(nodes.begin(), nodes.end(), node) != nodes.end()) continue;
    double distance = points.empty() ? 0 : std::numeric_limits<double>::infinity();
    for (const Vector3d& point : points)
      distance = std::min(distance, (places[node] - point).squaredNorm());
    others.push_back({distance, node});
  }
  const std::size_t room = std::min(wanted, others.size());
  std::partial_sort(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(room),
                    others.end(), [](const Candidate& a, const Candidate& b) {
                      return a.distance != b.distance ? a.distance < b.distance : a.node < b.node;
                    });
  for (std::size_t k = 0; k < room; ++k) nodes.push_back(others[k].node);
}

std::vector<int> GreensColumns::blockFor(std::span<const int> nodes,
                                         const std::vector<Vector3d>& places, bool isRough) const {
  std::vector<int> block;
  for (const int node : nodes) {
    if (block.size() == kBlock) break;
    if (indexOfNode_[node] >= 0 && !has(node, isRough) &&
        std::find(block.begin(), block.end(), node) == block.end())
      block.push_back(node);
  }
  if (!block.empty()) fillBlock(block, places, {places[block.front()]}, isRough);
  return block;
}

void GreensColumns::computeResponse(const SurfacePoint& point, double radius,
                                    std::span<const int> nodes, std::span<const double> traction,
                                    const Job& job, ReferenceProblem::Effort effort) {
  const auto turn = waitForTurn(job);
  if (responses_.isFull()) return;
  const bool isRough = effort == ReferenceProblem::Effort::kRough && problem_->hasRoughSolution();
  if (const auto* known = responses_.find(point, radius); known && (isRough || !known->isRough))
    return;
  const DegreesOfFreedom& dofs = problem_->dofs();
  MatrixXd known = MatrixXd::Zero(dofs.nodalCount(), 3);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (int axis = 0; axis < 3; ++axis)
      known(3 * nodes[k] + axis, axis) = traction[k] / dofs.tractionScale();
  const MatrixXd unknowns =
      problem_->solve(dofs.expand(MatrixXd::Zero(rows_, 3), known), effort, job);
  responses_.add({point, radius, unknowns.cast<float>(), isRough});
}

void GreensColumns::continueWith(std::shared_ptr<const ReferenceProblem> same) {
  const std::lock_guard lock(computing_);
  problem_ = std::move(same);
}

std::vector<int> GreensColumns::nodesNear(const std::vector<Vector3d>& places,
                                          const Vector3d& point) const {
  std::vector<int> order = nodes_;
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return (places[a] - point).squaredNorm() < (places[b] - point).squaredNorm();
  });
  return order;
}

}  // namespace palpa::bem
