#include "bem/compressed/far_blocks.h"

#include <cblas.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "base/part_of_job.h"
#include "base/scratch_pool.h"
#include "bem/compressed/falling_factors.h"
#include "bem/element/skeleton.h"

namespace palpa::bem {

using Eigen::Index;
using Eigen::MatrixXf;
using Eigen::Vector3d;

namespace {

/// Places of a distant cluster whose kernels stand for the kernels of all its functions.
constexpr int kSourcePlaces = 32;
/// Blocks whose right factors are stored together, at least.
constexpr std::size_t kBlocksAtOnce = 256;

struct Skeleton {
  std::vector<int> rows;  ///< 3 * point position + i
  MatrixXf weights;       ///< (row of the cluster, row of the skeleton)
};

class FarBlocksMaker {
 public:
  explicit FarBlocksMaker(const FarBlockInputs& inputs)
      : in_(inputs),
        tree_(inputs.order.tree),
        columns_(tree_.count()),
        isNeeded_(tree_.count()),
        skeletons_(tree_.count()) {
    result_.blocks.resize(static_cast<std::size_t>(tree_.count()));
    result_.bases.resize(static_cast<std::size_t>(tree_.count()));
    for (int c = 0; c < tree_.count(); ++c) {
      const std::vector<int>& all = in_.division.far[c];
      for (std::size_t b = 0; b < all.size(); ++b)
        if (in_.share.hasBlock(c, b)) columns_[c].push_back(all[b]);
      isNeeded_[c] = !columns_[c].empty() || (c > 0 && isNeeded_[(c - 1) / 2]);
    }
  }

  FarBlocks make(const Job& job) {
    int top = tree_.levelCount();
    std::size_t pairs = 0, done = 0;
    for (int level = tree_.levelCount() - 1; level >= 0; --level)
      for (int c = ClusterTree::firstOf(level); c < ClusterTree::firstOf(level + 1); ++c)
        if (!columns_[c].empty()) {
          top = level;
          pairs += columns_[c].size();
        }
    for (int level = tree_.levelCount() - 1; level >= top; --level) {
      const int first = ClusterTree::firstOf(level);
      parallelFor(ClusterTree::countOf(level), job, [&](std::ptrdiff_t k) {
        const int c = first + static_cast<int>(k);
        if (isNeeded_[c]) skeletons_[c] = skeletonOf(c);
      });
      if (level + 1 < tree_.levelCount())
        for (int c = ClusterTree::firstOf(level + 1); c < ClusterTree::firstOf(level + 2); ++c)
          skeletons_[c] = {};
      done = makeLevel(level, done, pairs, job);
    }
    return std::move(result_);
  }

 private:
  /// A block of a level, whose right factor is not stored yet.
  struct Made {
    int row;  ///< cluster of points
    FarBlock* to;
    RightFactor right;
  };

  /// Makes the blocks of a level after `done` of all `pairs`; returns how many are done then.
  std::size_t makeLevel(int level, std::size_t done, std::size_t pairs, const Job& job) {
    std::vector<std::vector<Made>> byColumn(static_cast<std::size_t>(tree_.count()));
    for (int c = ClusterTree::firstOf(level); c < ClusterTree::firstOf(level + 1); ++c) {
      std::vector<FarBlock>& blocks = result_.blocks[c];
      blocks.reserve(columns_[c].size());
      for (const int column : columns_[c]) blocks.push_back({column, {}});
      for (FarBlock& block : blocks) byColumn[block.column].push_back({c, &block, {}});
    }
    // Some clusters of functions at a time, because right factors are large before they are stored.
    ScratchPool<ExactRows::Scratch> pool([&] { return in_.exact.makeScratch(); });
    std::vector<Made*> made;
    std::vector<int> columns;
    const auto finish = [&] {
      const std::size_t end = done + made.size();
      parallelFor(static_cast<std::ptrdiff_t>(made.size()), partOfJob(job, done, end, pairs),
                  Phase::kAssemble, [&](std::ptrdiff_t k) {
                    ExactRows::Scratch scratch = pool.take();
                    makeBlock(*made[k], scratch, job);
                    pool.giveBack(std::move(scratch));
                  });
      parallelFor(static_cast<std::ptrdiff_t>(columns.size()), job,
                  [&](std::ptrdiff_t k) { storeRightFactors(columns[k], byColumn[columns[k]]); });
      done = end;
      made.clear();
      columns.clear();
    };
    for (std::size_t column = 0; column < byColumn.size(); ++column) {
      if (byColumn[column].empty()) continue;
      columns.push_back(static_cast<int>(column));
      for (Made& one : byColumn[column]) made.push_back(&one);
      if (made.size() >= kBlocksAtOnce) finish();
    }
    finish();
    return done;
  }

  /// Stores and empties the right factors of the blocks of a cluster of functions.
  void storeRightFactors(int column, std::vector<Made>& made) {
    const Index ofNodes = in_.order.nodeColumns(column), ofSlots = in_.order.slotColumns(column);
    std::vector<const RightFactor*> factors;
    double distance = 0;
    for (const Made& one : made) {
      factors.push_back(&one.right);
      distance += distanceOf(one.row, column) / static_cast<double>(made.size());
    }
    std::optional<CombinedFactors> combined;
    if (in_.hasBases)
      combined = combineFactors(factors, ofSlots, static_cast<float>(in_.shear / distance),
                                static_cast<unsigned>(column));
    for (std::size_t k = 0; k < made.size(); ++k) {
      FarBlock& to = *made[k].to;
      if (combined) {
        to.coefficients = std::move(combined->coefficients[k]);
      } else if (made[k].right.V.rows() > 0) {
        const RightFactor& right = made[k].right;
        to.ofNodes = {right.V.leftCols(ofNodes), right.bits};
        to.ofSlots = {right.V.rightCols(ofSlots), right.bits};
      }
    }
    if (combined) result_.bases[column] = std::move(combined->basis);
    made = std::vector<Made>();  // also gives back the memory
  }

  double distanceOf(int row, int column) const {
    return (in_.division.pointBalls[row].centre - in_.division.functionBalls[column].centre).norm();
  }

  /// Rows of a cluster from which the fields of all distant forces are interpolated, chosen among
  /// the rows of its sons.
  Skeleton skeletonOf(int cluster) const {
    std::vector<int> candidates;
    if (tree_.isLeaf(cluster)) {
      candidates.resize(static_cast<std::size_t>(in_.order.rows(cluster)));
      std::iota(candidates.begin(), candidates.end(), 3 * in_.order.pointBegin(cluster));
    } else {
      for (int son = 2 * cluster + 1; son <= 2 * cluster + 2; ++son)
        candidates.insert(candidates.end(), skeletons_[son].rows.begin(),
                          skeletons_[son].rows.end());
    }
    Ball ball = in_.division.pointBalls[cluster];
    ball.radius = std::max(ball.radius, 1e-3 * in_.division.functionBalls[cluster].radius);
    RowChoice choice =
        chooseSkeleton(in_.constants, in_.points, candidates, ball, in_.tolerance / 2);
    Skeleton skeleton;
    for (const int row : choice.rows) skeleton.rows.push_back(candidates[row]);
    if (tree_.isLeaf(cluster)) {
      skeleton.weights = std::move(choice.weights);
      return skeleton;
    }
    skeleton.weights.resize(in_.order.rows(cluster), choice.weights.cols());
    Index row = 0, candidate = 0;
    for (int son = 2 * cluster + 1; son <= 2 * cluster + 2; ++son) {
      const MatrixXf& ofSon = skeletons_[son].weights;
      if (ofSon.size() > 0)
        cblas_sgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, static_cast<int>(ofSon.rows()),
                    static_cast<int>(choice.weights.cols()), static_cast<int>(ofSon.cols()), 1,
                    ofSon.data(), static_cast<int>(ofSon.rows()), choice.weights.data() + candidate,
                    static_cast<int>(choice.weights.rows()), 0, skeleton.weights.data() + row,
                    static_cast<int>(skeleton.weights.rows()));
      row += ofSon.rows();
      candidate += ofSon.cols();
    }
    return skeleton;
  }

  /// Kernels of some places of a distant cluster at the rows of a skeleton.
  RowMatrixXf fieldsOf(int column, const Skeleton& skeleton, double distance) const {
    const ClusterTree::Cluster range = tree_.cluster(column);
    const int places = std::min(kSourcePlaces, range.size());
    RowMatrixXf fields(static_cast<Index>(skeleton.rows.size()), 6 * static_cast<Index>(places));
    for (std::size_t k = 0; k < skeleton.rows.size(); ++k) {
      const Vector3d& x = in_.points[skeleton.rows[k] / 3];
      const int i = skeleton.rows[k] % 3;
      float* row = fields.row(static_cast<Index>(k)).data();
      for (int q = 0; q < places; ++q) {
        const int position =
            range.begin + static_cast<int>((2 * q + 1) * static_cast<std::ptrdiff_t>(range.size()) /
                                           (2 * places));
        const int node = tree_.order()[position], first = in_.slots.firstOfNode[node],
                  slotCount = in_.slots.firstOfNode[node + 1] - first;
        const Vector3d& n = in_.slots.slots[first + q % slotCount].normal;
        // The factor makes kernels of forces and dislocations comparable.
        setForce(in_.constants, x, in_.nodes[node], i, in_.shear / distance, row + 6 * q);
        setDislocation(in_.constants, x, in_.nodes[node], n, i, 1, row + 6 * q + 3);
      }
    }
    return fields;
  }

  void makeBlock(Made& made, ExactRows::Scratch& scratch, const Job& job) const {
    const int column = made.to->column;
    const Skeleton& skeleton = skeletons_[made.row];
    const double distance = distanceOf(made.row, column);
    const RowChoice choice =
        chooseRows(fieldsOf(column, skeleton, distance), static_cast<float>(in_.tolerance));
    const auto rank = static_cast<int>(choice.rows.size());
    RowMatrixXf U(rank, skeleton.weights.rows());
    if (U.size() > 0)
      cblas_sgemm(CblasRowMajor, CblasNoTrans, CblasNoTrans, rank, static_cast<int>(U.cols()),
                  static_cast<int>(skeleton.weights.cols()), 1, choice.weights.data(),
                  static_cast<int>(choice.weights.rows()), skeleton.weights.data(),
                  static_cast<int>(skeleton.weights.rows()), 0, U.data(),
                  static_cast<int>(U.cols()));
    const int columns = in_.order.columns(column);
    RowMatrixXf V(rank, columns);
    // The rows of a point are computed together.
    std::vector<int> byPoint(static_cast<std::size_t>(rank));
    std::iota(byPoint.begin(), byPoint.end(), 0);
    const auto rowOf = [&](int k) { return skeleton.rows[choice.rows[k]]; };
    std::sort(byPoint.begin(), byPoint.end(), [&](int a, int b) { return rowOf(a) < rowOf(b); });
    RowMatrixXf ofPoint(3, columns);
    int computed = -1;
    for (const int k : byPoint) {
      const int position = rowOf(k) / 3;
      if (position != computed) {
        job.throwIfCancelled();
        in_.exact.compute(in_.equations.points[in_.order.points[position]], column, {}, scratch,
                          ofPoint.data());
        computed = position;
      }
      V.row(k) = ofPoint.row(rowOf(k) % 3);
    }
    // As in fieldsOf().
    const auto importance = static_cast<float>(in_.shear / distance);
    FallingFactors factors = fallingFactors(U, V, in_.order.slotColumns(column), importance);
    made.to->U = {factors.U, factors.bitsOfU};
    made.right = {std::move(factors.V), std::move(factors.bitsOfV)};
  }

  const FarBlockInputs& in_;
  const ClusterTree& tree_;
  std::vector<std::vector<int>> columns_;  ///< clusters of functions of the blocks of the share
  std::vector<char> isNeeded_;             ///< skeletons for these blocks
  std::vector<Skeleton> skeletons_;
  FarBlocks result_;
};

}  // namespace

FarBlocks makeFarBlocks(const FarBlockInputs& inputs, const Job& job) {
  return FarBlocksMaker(inputs).make(job);
}

}  // namespace palpa::bem
