#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "base/stoppable_mutex.h"
#include "bem/base/large_matrix.h"
#include "bem/problem/mask_responses.h"
#include "bem/problem/reference_problem.h"
#include "bem/problem/rough_columns.h"

namespace palpa::bem {

/// Columns that are known before any is computed.
struct KnownColumns {
  std::vector<int> nodes;  ///< free ones
  Eigen::MatrixXf values;  ///< (unknown, 3 k + axis) of nodes[k], as GreensColumns::column()
};

/// Columns of Xi of free nodes (displacement coefficients), computed while others are in use: any
/// number of readers use the available columns; threads that compute columns take turns, block by
/// block.
/// Single precision (unrefined: about 1e-5 relative). Memory: 12 n rows() bytes for n free nodes,
/// reserved at once but taken from the system only when columns are computed.
class GreensColumns {
 public:
  /// Throws SolverError (kTooLarge) if the memory cannot be reserved.
  explicit GreensColumns(std::shared_ptr<const ReferenceProblem> problem);

  const ReferenceProblem& problem() const { return *problem_; }

  /// True if the three columns of a node are available, not rough ones; always false for a node
  /// that is not free.
  bool has(int node) const {
    return indexOfNode_[node] >= 0 &&
           isReady_[indexOfNode_[node]].load(std::memory_order_acquire) != 0;
  }
  bool hasAll(std::span<const int> nodes) const;
  /// The same with rough ones, which better ones will replace.
  bool hasRough(int node) const {
    return has(node) || (indexOfNode_[node] >= 0 && rough_.find(indexOfNode_[node]));
  }
  bool hasAllRough(std::span<const int> nodes) const;
  /// Number of free nodes with available columns.
  int readyCount() const { return readyCount_.load(std::memory_order_acquire); }
  int nodeCount() const { return static_cast<int>(nodes_.size()); }
  bool isComplete() const { return readyCount() == nodeCount(); }

  /// The three columns of a free node, rows() numbers each: unknowns v per unit of the scaled
  /// traction along x, y, z. hasRough(node) must be true; rough only while nothing better is known.
  const float* column(int node, int axis) const {
    const int index = indexOfNode_[node];
    if (isReady_[index].load(std::memory_order_acquire) == 0)
      return rough_.find(index) + rows_ * axis;
    return columns_.data() + rows_ * (3 * static_cast<Eigen::Index>(index) + axis);
  }
  Eigen::Index rows() const { return rows_; }

  /// Takes columns that another object has computed for the same problem.
  void take(const KnownColumns& known);
  /// The columns of nodes that are available.
  KnownColumns copyOf(std::span<const int> nodes) const;

  /// Computes the missing columns of these nodes in blocks; skips nodes that are not free. Other
  /// threads may read and compute meanwhile. Throws Cancelled and keeps the finished blocks. All
  /// blocks have the same size (the last node is repeated), so that a column does not depend on the
  /// other columns of its block.
  void compute(std::span<const int> nodes, const Job& job,
               ReferenceProblem::Effort effort = ReferenceProblem::Effort::kFast);

  /// compute() of these nodes and of their nearest neighbours that fill the last block at no
  /// additional cost: a tool that moves on needs them next. `places`: of all nodes
  /// (ContactSurface::places()).
  void computeAround(std::span<const int> nodes, const std::vector<Eigen::Vector3d>& places,
                     const Job& job);
  /// Adds free nodes without columns to a list of distinct nodes, nearest to some points first,
  /// until it fills its last block. Without points: by their number. `isRough`: without rough
  /// columns.
  void fillBlock(std::vector<int>& nodes, const std::vector<Eigen::Vector3d>& places,
                 const std::vector<Eigen::Vector3d>& points, bool isRough = false) const;
  /// The first free ones of some nodes without columns, filled with the nodes nearest to the first
  /// of them. Empty if all have columns. `isRough`: rough ones suffice.
  std::vector<int> blockFor(std::span<const int> nodes, const std::vector<Eigen::Vector3d>& places,
                            bool isRough = false) const;

  /// Computes rough columns of distinct nodes that have none, in blocks. Does nothing without
  /// hasRoughSolution() of the problem, or if there are RoughColumns::kMaxBlocks blocks of them.
  /// Other threads may read, and compute when this ends. Throws Cancelled.
  void computeRough(std::span<const int> nodes, const Job& job);
  /// False if computeRough() does nothing.
  bool takesRough() const { return problem_->hasRoughSolution() && !rough_.isFull(); }

  /// Responses to single masks, for places whose columns are not available yet.
  const MaskResponses& responses() const { return responses_; }
  /// Solves for the response of a mask, three columns instead of all of its nodes,
  /// with the effort kFast, or kRough, which kFast may follow. `point`, `radius`, `nodes` and
  /// `traction`: of the ContactMask. Does nothing if a response as good as this is known, or if
  /// there are MaskResponses::kMaxCount. Other threads may read and compute meanwhile. Throws
  /// Cancelled.
  void computeResponse(const SurfacePoint& point, double radius, std::span<const int> nodes,
                       std::span<const double> traction, const Job& job,
                       ReferenceProblem::Effort effort = ReferenceProblem::Effort::kFast);

  /// The free nodes ordered by their distance from a point, nearest first: the order of computation
  /// for a touch there. `places`: of all nodes (ContactSurface::places()).
  std::vector<int> nodesNear(const std::vector<Eigen::Vector3d>& places,
                             const Eigen::Vector3d& point) const;

  std::size_t bytes() const { return columns_.bytes(); }
  /// Memory of the columns that are available.
  double usedBytes() const {
    return blockBytes() * (static_cast<double>(readyCount()) / kBlock + rough_.count());
  }
  /// Memory that compute() needs for a block.
  double blockBytes() const { return 3.0 * kBlock * static_cast<double>(rows_) * sizeof(float); }

  /// Computes further columns with another problem that has the same operators and degrees of
  /// freedom: a full rebuild from the same mesh. Waits for a block that is being computed.
  void continueWith(std::shared_ptr<const ReferenceProblem> same);

  /// Nodes per block of compute(): enough for the solver to be efficient, few enough to stop soon.
  static constexpr int kBlock = 32;

 private:
  std::unique_lock<StoppableMutex> waitForTurn(const Job& job);
  bool has(int node, bool isRough) const { return isRough ? hasRough(node) : has(node); }
  /// Columns of kBlock nodes; the last one is repeated.
  Eigen::MatrixXd solveBlock(std::span<const int> nodes, ReferenceProblem::Effort effort,
                             const Job& job) const;

  StoppableMutex computing_;  // held by the thread that computes a block
  std::shared_ptr<const ReferenceProblem> problem_;
  Eigen::Index rows_;
  std::vector<int> nodes_;        // the free ones
  std::vector<int> indexOfNode_;  // into nodes_; -1: not free
  std::unique_ptr<std::atomic<unsigned char>[]> isReady_;
  std::atomic<int> readyCount_{0};
  MaskResponses responses_;
  RoughColumns rough_;
  LargeMatrix<float> columns_;
};

}  // namespace palpa::bem
