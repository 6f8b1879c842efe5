#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>

#include "base/parallel.h"
#include "base/scratch_pool.h"
#include "bem/compressed/compressed_operators.h"
#include "bem/element/averaged_rows.h"
#include "bem/element/kelvin_blocks.h"
#include "bem/linalg/blas_threads.h"

#include <cblas.h>

namespace palpa::bem {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::MatrixXf;
using Eigen::Vector3d;

namespace {

/// Leaves have half as many nodes at least. The equations keep the integrals over nearer elements
/// in any case.
constexpr int kLeafSize = 40;
/// Radius over the radius of a cluster of points outside of which functions are distant: their
/// fields on the cluster are fields of forces on a sphere of this radius.
constexpr double kFarRatio = 1.5;
/// Forces on this sphere: half a radius of the cluster apart. Measured: products have relative
/// errors of 1e-5 for a tolerance of 1e-5, 4e-5 for 1e-4.
constexpr int kForcesOnSphere = 128;
/// Places of a distant cluster whose kernels stand for the kernels of all its functions.
constexpr int kSourcePlaces = 32;

/// Even points on the unit sphere, on a spiral.
std::vector<Vector3d> spiral(int count) {
  std::vector<Vector3d> points;
  const double turn = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int k = 0; k < count; ++k) {
    const double z = 1 - (2 * k + 1.0) / count, radius = std::sqrt(1 - z * z);
    points.emplace_back(radius * std::cos(turn * k), radius * std::sin(turn * k), z);
  }
  return points;
}

/// Component i of Kelvin's displacement U at x by unit forces at y along 0, 1, 2.
void addForce(const KelvinConstants& k, const Vector3d& x, const Vector3d& y, int i, double factor,
              float* to) {
  const Vector3d r = y - x;
  const double inverse = 1 / r.norm(), cubed = inverse * inverse * inverse;
  for (int c = 0; c < 3; ++c)
    to[c] = static_cast<float>(factor * k.weightU *
                               (r[i] * r[c] * cubed + (i == c ? k.diagonalU * inverse : 0)));
}

/// Row i of Kelvin's traction kernel T(x, y) at a surface point y with normal n.
void addDislocation(const KelvinConstants& k, const Vector3d& x, const Vector3d& y,
                    const Vector3d& n, int i, double factor, float* to) {
  const Vector3d r = y - x;
  const double inverse = 1 / r.norm(), cubed = inverse * inverse * inverse,
               fifth = cubed * inverse * inverse * r.dot(n);
  const Vector3d turn = cubed * r.cross(n);
  const double sums[kKernelSumsT] = {fifth * r[0] * r[0],
                                     fifth * r[0] * r[1],
                                     fifth * r[1] * r[1],
                                     fifth * r[0] * r[2],
                                     fifth * r[1] * r[2],
                                     fifth * r[2] * r[2],
                                     turn[0],
                                     turn[1],
                                     turn[2]};
  for (int c = 0; c < 3; ++c)
    to[c] = static_cast<float>(factor * detail::BlockT::component(k, sums, i, c));
}

/// Job whose progress runs from `begin` to `end`.
Job partOfJob(const Job& job, double begin, double end) {
  Job part = job;
  if (job.progress)
    part.progress = [progress = job.progress, begin, end](Phase phase, double fraction) {
      progress(phase, begin + fraction * (end - begin));
    };
  return part;
}

/// Blocks of one row in the making.
struct RowEntries {
  std::vector<std::pair<int, Matrix3d>> entries;
};

BlockRows blockRowsOf(std::vector<RowEntries> rows) {
  BlockRows result;
  result.begin.push_back(0);
  for (RowEntries& row : rows) {
    std::stable_sort(row.entries.begin(), row.entries.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t k = 0; k < row.entries.size();) {
      const int column = row.entries[k].first;
      Matrix3d sum = Matrix3d::Zero();
      for (; k < row.entries.size() && row.entries[k].first == column; ++k)
        sum += row.entries[k].second;
      result.columns.push_back(column);
      auto& block = result.blocks.emplace_back();
      for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 3; ++c) block[3 * i + c] = static_cast<float>(sum(i, c));
    }
    result.begin.push_back(result.columns.size());
    row.entries = {};
  }
  return result;
}

}  // namespace

/// One assembly. Rows of P far from a cluster of functions are smooth functions of the point: in
/// each cluster of points a few rows are chosen from which the fields of all distant forces are
/// interpolated (skeletons, from the leaves up), then from these for each block those from which
/// the fields of its functions are; only their integrals are computed. The choice uses kernels at
/// points instead of integrals.
class CompressedAssembly {
 public:
  CompressedAssembly(const ElementSurface& surface, const ElementQuadrature& quadrature,
                     const WeightedEquations& equations, const std::vector<Vector3d>& nodes,
                     const TractionSlots& slots, const Material& material, double tolerance,
                     const Job& job)
      : surface_(surface),
        quadrature_(quadrature),
        equations_(equations),
        nodes_(nodes),
        slots_(slots),
        tolerance_(static_cast<float>(tolerance)),
        job_(job),
        rowsOfSurface_(surface, quadrature, material),
        constants_(rowsOfSurface_.constants()),
        averaged_(surface, quadrature, constants_, equations, std::nullopt),
        forceScale_(material.shear()) {
    useOneBlasThread();
    setOrder();
    job_.throwIfCancelled();
    exact_.emplace(surface_, quadrature_, constants_, result_.order_);
    divide();
  }

  CompressedOperators run() {
    addFarBlocks(partOfJob(job_, 0, 0.5));
    addNearBlocks(partOfJob(job_, 0.5, 0.65));
    const std::vector<AveragedRows::Total> totals = addCorrections(partOfJob(job_, 0.65, 0.75));
    addAveraged(totals, partOfJob(job_, 0.75, 1));
    return std::move(result_);
  }

 private:
  struct Skeleton {
    std::vector<int> rows;  ///< internal, 3 * point position + i
    MatrixXf weights;       ///< (row of the cluster, row of the skeleton)
  };

  const ClusterTree& tree() const { return result_.order_.tree; }
  const CollocationPlace& point(int position) const {
    return equations_.points[result_.order_.points[position]];
  }

  /// Node beside each point: the node of its equation, or the node itself.
  std::vector<int> nodeOfPoints() const {
    std::vector<int> node(equations_.points.size(), -1);
    for (const AveragedElement& element : equations_.averaged)
      for (std::size_t k = 0; k < element.nodes.size(); ++k)
        node[element.nodes[k]] = surface_.coefficients(element.element)[k];
    for (Index p = 0; p < equations_.weights.cols(); ++p) {
      if (node[p] >= 0) continue;
      // The nearest node of an element with the point.
      const CollocationPlace& place = equations_.points[p];
      double least = INFINITY;
      for (const int candidate : surface_.coefficients(place.places.front().element))
        if (const double distance = (nodes_[candidate] - place.position).squaredNorm();
            distance < least) {
          least = distance;
          node[p] = candidate;
        }
    }
    return node;
  }

  void setOrder() {
    CompressedOrder& order = result_.order_;
    order.tree = ClusterTree(nodes_, kLeafSize);
    const auto n = static_cast<int>(nodes_.size());
    order.firstSlot.push_back(0);
    for (const int node : order.tree.order()) {
      for (int s = slots_.firstOfNode[node]; s < slots_.firstOfNode[node + 1]; ++s)
        order.slots.push_back(s);
      order.firstSlot.push_back(static_cast<int>(order.slots.size()));
    }
    std::vector<std::vector<int>> pointsOfNode(nodes_.size());
    const std::vector<int> node = nodeOfPoints();
    for (std::size_t p = 0; p < node.size(); ++p)
      pointsOfNode[node[p]].push_back(static_cast<int>(p));
    order.firstPoint.push_back(0);
    for (int k = 0; k < n; ++k) {
      for (const int p : pointsOfNode[order.tree.order()[k]]) order.points.push_back(p);
      order.firstPoint.push_back(static_cast<int>(order.points.size()));
    }
    const auto invert = [](const std::vector<int>& list) {
      std::vector<int> inverse(list.size());
      for (std::size_t k = 0; k < list.size(); ++k) inverse[list[k]] = static_cast<int>(k);
      return inverse;
    };
    order.slotPositionOf = invert(order.slots);
    order.pointPositionOf = invert(order.points);
    std::vector<Eigen::Triplet<float>> weights;
    for (Index p = 0; p < equations_.weights.cols(); ++p)
      for (Eigen::SparseMatrix<double>::InnerIterator w(equations_.weights, p); w; ++w)
        weights.emplace_back(static_cast<int>(w.row()), order.pointPositionOf[p],
                             static_cast<float>(w.value()));
    result_.weights_.resize(equations_.weights.rows(), equations_.weights.cols());
    result_.weights_.setFromTriplets(weights.begin(), weights.end());
  }

  /// Divides all pairs of clusters of a level into distant ones and near leaves.
  void divide() {
    const int count = tree().count();
    std::vector<Vector3d> places;
    for (int c = 0; c < count; ++c) {
      places.clear();
      for (int p = result_.order_.pointBegin(c); p < result_.order_.pointEnd(c); ++p)
        places.push_back(point(p).position);
      pointBalls_.push_back(places.empty() ? Ball{} : ballAround(places));
      places.clear();
      for (const int e : exact_->elements(c))
        for (const int node : surface_.coefficients(e)) places.push_back(nodes_[node]);
      functionBalls_.push_back(ballAround(places));
    }
    farPairs_.resize(count);
    nearPairs_.resize(count);
    divide(0, 0);
    for (auto& list : nearPairs_) std::sort(list.begin(), list.end());
    result_.far_.resize(count);
    result_.near_.resize(static_cast<std::size_t>(ClusterTree::countOf(tree().levelCount() - 1)));
  }

  void divide(int row, int column) {
    if (tree().isLeaf(row)) job_.throwIfCancelled();
    if (result_.order_.rows(row) == 0) return;
    const double distance = (pointBalls_[row].centre - functionBalls_[column].centre).norm() -
                            functionBalls_[column].radius;
    // A few points on one place have no radius.
    const double radius = std::max(pointBalls_[row].radius, 0.1 * functionBalls_[column].radius);
    if (distance >= kFarRatio * radius) {
      farPairs_[row].push_back(column);
    } else if (tree().isLeaf(row)) {
      nearPairs_[row].push_back(column);
    } else {
      for (int a = 1; a <= 2; ++a)
        for (int b = 1; b <= 2; ++b) divide(2 * row + a, 2 * column + b);
    }
  }

  double radiusOf(int cluster) const {
    return std::max(pointBalls_[cluster].radius, 1e-3 * functionBalls_[cluster].radius);
  }

  /// Rows of a cluster from which the fields of all distant forces are interpolated.
  Skeleton skeletonOf(int cluster, const std::vector<Skeleton>& skeletons) const {
    std::vector<int> candidates;
    if (tree().isLeaf(cluster)) {
      candidates.resize(static_cast<std::size_t>(result_.order_.rows(cluster)));
      std::iota(candidates.begin(), candidates.end(), 3 * result_.order_.pointBegin(cluster));
    } else {
      for (int son = 2 * cluster + 1; son <= 2 * cluster + 2; ++son)
        candidates.insert(candidates.end(), skeletons[son].rows.begin(), skeletons[son].rows.end());
    }
    static const std::vector<Vector3d> directions = spiral(kForcesOnSphere);
    const double radius = kFarRatio * radiusOf(cluster);
    RowMatrixXf fields(static_cast<Index>(candidates.size()), 3 * kForcesOnSphere);
    for (std::size_t k = 0; k < candidates.size(); ++k)
      for (int q = 0; q < kForcesOnSphere; ++q)
        addForce(constants_, point(candidates[k] / 3).position,
                 pointBalls_[cluster].centre + radius * directions[q], candidates[k] % 3,
                 forceScale_, fields.row(static_cast<Index>(k)).data() + 3 * q);
    const RowChoice choice = chooseRows(std::move(fields), tolerance_ / 2);
    Skeleton skeleton;
    for (const int row : choice.rows) skeleton.rows.push_back(candidates[row]);
    if (tree().isLeaf(cluster)) {
      skeleton.weights = choice.weights;
      return skeleton;
    }
    skeleton.weights.resize(result_.order_.rows(cluster), choice.weights.cols());
    Index row = 0, candidate = 0;
    for (int son = 2 * cluster + 1; son <= 2 * cluster + 2; ++son) {
      const MatrixXf& ofSon = skeletons[son].weights;
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
    const ClusterTree::Cluster range = tree().cluster(column);
    const int places = std::min(kSourcePlaces, range.size());
    RowMatrixXf fields(static_cast<Index>(skeleton.rows.size()), 6 * static_cast<Index>(places));
    for (std::size_t k = 0; k < skeleton.rows.size(); ++k) {
      const Vector3d& x = point(skeleton.rows[k] / 3).position;
      const int i = skeleton.rows[k] % 3;
      float* row = fields.row(static_cast<Index>(k)).data();
      for (int q = 0; q < places; ++q) {
        const int position =
            range.begin + static_cast<int>((2 * q + 1) * static_cast<std::ptrdiff_t>(range.size()) /
                                           (2 * places));
        const int node = tree().order()[position];
        const int slotCount = slots_.firstOfNode[node + 1] - slots_.firstOfNode[node];
        const Vector3d& n = slots_.slots[slots_.firstOfNode[node] + q % slotCount].normal;
        addForce(constants_, x, nodes_[node], i, forceScale_ / distance, row + 6 * q);
        addDislocation(constants_, x, nodes_[node], n, i, 1, row + 6 * q + 3);
      }
    }
    return fields;
  }

  CompressedOperators::FarBlock farBlock(int row, int column, const Skeleton& skeleton,
                                         ExactRows::Scratch& scratch, const Job& job) const {
    const double distance = (pointBalls_[row].centre - functionBalls_[column].centre).norm();
    const RowChoice choice = chooseRows(fieldsOf(column, skeleton, distance), tolerance_);
    CompressedOperators::FarBlock block;
    block.column = column;
    const auto rank = static_cast<int>(choice.rows.size());
    block.U.resize(skeleton.weights.rows(), rank);
    if (rank > 0 && block.U.rows() > 0)
      cblas_sgemm(CblasRowMajor, CblasTrans, CblasTrans, static_cast<int>(block.U.rows()), rank,
                  static_cast<int>(skeleton.weights.cols()), 1, skeleton.weights.data(),
                  static_cast<int>(skeleton.weights.rows()), choice.weights.data(),
                  static_cast<int>(choice.weights.rows()), 0, block.U.data(), rank);
    const int columns = result_.order_.columns(column);
    block.V.resize(rank, columns);
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
        exact_->compute(point(position), column, {}, scratch, ofPoint.data());
        computed = position;
      }
      block.V.row(k) = ofPoint.row(rowOf(k) % 3);
    }
    return block;
  }

  void addFarBlocks(const Job& job) {
    std::vector<Skeleton> skeletons(static_cast<std::size_t>(tree().count()));
    int top = tree().levelCount();
    std::size_t pairs = 0;
    for (int level = tree().levelCount() - 1; level >= 0; --level)
      for (int c = ClusterTree::firstOf(level); c < ClusterTree::firstOf(level + 1); ++c)
        if (!farPairs_[c].empty()) {
          top = level;
          pairs += farPairs_[c].size();
        }
    ScratchPool<ExactRows::Scratch> pool([&] { return exact_->makeScratch(); });
    std::atomic<std::size_t> done{0};
    for (int level = tree().levelCount() - 1; level >= top; --level) {
      const int first = ClusterTree::firstOf(level);
      parallelFor(ClusterTree::countOf(level), job, [&](std::ptrdiff_t k) {
        const int c = first + static_cast<int>(k);
        skeletons[c] = skeletonOf(c, skeletons);
      });
      if (level + 1 < tree().levelCount())
        for (int c = ClusterTree::firstOf(level + 1); c < ClusterTree::firstOf(level + 2); ++c)
          skeletons[c] = {};
      std::vector<std::pair<int, std::size_t>> blocks;
      for (int c = first; c < ClusterTree::firstOf(level + 1); ++c) {
        result_.far_[c].resize(farPairs_[c].size());
        for (std::size_t b = 0; b < farPairs_[c].size(); ++b) blocks.emplace_back(c, b);
      }
      const Job ofLevel =
          partOfJob(job, static_cast<double>(done) / static_cast<double>(pairs),
                    static_cast<double>(done + blocks.size()) / static_cast<double>(pairs));
      parallelFor(static_cast<std::ptrdiff_t>(blocks.size()), ofLevel, Phase::kAssemble,
                  [&](std::ptrdiff_t k) {
                    const auto [c, b] = blocks[k];
                    ExactRows::Scratch scratch = pool.take();
                    result_.far_[c][b] = farBlock(c, farPairs_[c][b], skeletons[c], scratch, job);
                    pool.giveBack(std::move(scratch));
                  });
      done += blocks.size();
    }
  }

  void addNearBlocks(const Job& job) {
    const int firstLeaf = ClusterTree::firstOf(tree().levelCount() - 1);
    ScratchPool<ExactRows::Scratch> pool([&] { return exact_->makeScratch(); });
    parallelFor(tree().count() - firstLeaf, job, Phase::kAssemble, [&](std::ptrdiff_t k) {
      const int leaf = firstLeaf + static_cast<int>(k);
      ExactRows::Scratch scratch = pool.take();
      RowMatrixXf ofPoint;
      for (const int column : nearPairs_[leaf]) {
        job.throwIfCancelled();
        MatrixXf K(result_.order_.rows(leaf), result_.order_.columns(column));
        ofPoint.resize(3, K.cols());
        for (int p = result_.order_.pointBegin(leaf); p < result_.order_.pointEnd(leaf); ++p) {
          exact_->compute(point(p), column,
                          averaged_.leftOut(static_cast<std::size_t>(result_.order_.points[p])),
                          scratch, ofPoint.data());
          K.middleRows<3>(3 * static_cast<Index>(p - result_.order_.pointBegin(leaf))) = ofPoint;
        }
        if (!K.isZero(0)) result_.near_[k].push_back({column, std::move(K)});
      }
      pool.giveBack(std::move(scratch));
    });
  }

  bool isNear(int leaf, int other) const {
    return std::binary_search(nearPairs_[leaf].begin(), nearPairs_[leaf].end(), other);
  }

  /// Takes the elements that a point leaves out from its distant blocks.
  void subtractLeftOut(int position, ExactRows::Scratch& scratch, RowEntries& row) const {
    const int leaf = leafOfPoint_[position];
    for (const int e :
         averaged_.leftOut(static_cast<std::size_t>(result_.order_.points[position]))) {
      const std::vector<int>&nodes = surface_.coefficients(e), &slots = surface_.slots(e);
      const auto isDistant = [&](int node) {
        return !isNear(leaf, tree().leafOf(tree().positionOf()[node]));
      };
      if (std::none_of(nodes.begin(), nodes.end(), isDistant)) continue;
      quadrature_.integrate(e, point(position).position, placeIn(point(position), e),
                            *scratch.quadrature);
      for (std::size_t f = 0; f < nodes.size(); ++f) {
        if (!isDistant(nodes[f])) continue;
        const double* sums = scratch.quadrature->sums[f].of;
        Matrix3d T, U;
        for (int i = 0; i < 3; ++i)
          for (int c = 0; c < 3; ++c) {
            T(i, c) = detail::BlockT::component(constants_, sums + kKernelSumsU, i, c);
            U(i, c) = detail::BlockU::component(constants_, sums, i, c);
          }
        row.entries.emplace_back(tree().positionOf()[nodes[f]], T);
        row.entries.emplace_back(result_.nodeCount() + result_.order_.slotPositionOf[slots[f]], -U);
      }
    }
  }

  /// Completes P; returns the sums of its rows in the form of AveragedRows.
  std::vector<AveragedRows::Total> addCorrections(const Job& job) {
    const auto points = static_cast<std::ptrdiff_t>(equations_.points.size());
    leafOfPoint_.resize(equations_.points.size());
    for (int position = 0; position < result_.nodeCount(); ++position)
      for (int p = result_.order_.firstPoint[position];
           p < result_.order_.firstPoint[static_cast<std::size_t>(position) + 1]; ++p)
        leafOfPoint_[p] = tree().leafOf(position);
    std::vector<RowEntries> rows(equations_.points.size());
    ScratchPool<ExactRows::Scratch> pool([&] { return exact_->makeScratch(); });
    constexpr std::ptrdiff_t kPointsPerTask = 16;
    parallelFor((points + kPointsPerTask - 1) / kPointsPerTask, job, Phase::kAssemble,
                [&](std::ptrdiff_t task) {
                  ExactRows::Scratch scratch = pool.take();
                  for (auto p = static_cast<int>(task * kPointsPerTask);
                       p < std::min(points, (task + 1) * kPointsPerTask); ++p)
                    subtractLeftOut(p, scratch, rows[p]);
                  pool.giveBack(std::move(scratch));
                });
    result_.corrections_ = blockRowsOf(rows);
    RowMatrixXf translations = RowMatrixXf::Zero(
                    3 * (result_.nodeCount() + static_cast<Index>(result_.order_.slots.size())), 3),
                sums;
    for (Index k = 0; k < result_.nodeCount(); ++k) translations.middleRows<3>(3 * k).setIdentity();
    result_.applyToPoints(translations, sums, job);
    std::vector<AveragedRows::Total> totals(equations_.points.size());
    std::vector<double> basis;
    for (int p = 0; p < points; ++p) {
      const Matrix3d sum = sums.middleRows<3>(3 * static_cast<Index>(p)).cast<double>();
      const auto original = static_cast<std::size_t>(result_.order_.points[p]);
      totals[original] = totalOf(-sum);
      if (!averaged_.leftOut(original).empty()) continue;
      const ElementPlace& place = point(p).places.front();
      surface_.evaluateBasis(place, basis);
      for (std::size_t f = 0; f < basis.size(); ++f)
        if (basis[f] != 0)
          rows[p].entries.emplace_back(tree().positionOf()[surface_.coefficients(place.element)[f]],
                                       -basis[f] * sum);
    }
    result_.corrections_ = blockRowsOf(std::move(rows));
    return totals;
  }

  /// The sums of Kelvin's kernels whose block is `T`.
  AveragedRows::Total totalOf(const Matrix3d& T) const {
    const Matrix3d block = T / constants_.weightT;
    const double d = constants_.diagonalT, trace = block.trace() / (3 + 3 * d);
    AveragedRows::Total total{};
    for (int i = 0; i < 3; ++i) {
      const int c = (i + 1) % 3;
      total[detail::kPackedSum[i][i]] = (block(i, i) - d * trace) / 3;
      total[detail::kPackedSum[i][c]] = (block(i, c) + block(c, i)) / 6;
      // Without a factor there is no such term.
      total[6 + 3 - i - c] = d > 0 ? (block(c, i) - block(i, c)) / (2 * d) : 0;
    }
    return total;
  }

  void addAveraged(const std::vector<AveragedRows::Total>& totals, const Job& job) {
    const std::vector<AveragedElement>& averaged = equations_.averaged;
    BlockRows& N = result_.averaged_;
    setAveragedColumns(job);
    N.blocks.assign(N.columns.size(), {});
    constexpr std::ptrdiff_t kAtOnce = 256;
    const auto count = static_cast<std::ptrdiff_t>(averaged.size());
    ScratchPool<AveragedRows::Scratch> pool([&] { return averaged_.makeScratch(); });
    std::vector<AveragedRows::Blocks> blocks(kAtOnce);
    const int columns = result_.nodeCount() + static_cast<int>(result_.order_.slots.size());
    std::vector<std::vector<std::size_t>> places(
        2, std::vector<std::size_t>(static_cast<std::size_t>(columns)));
    for (std::ptrdiff_t first = 0; first < count; first += kAtOnce) {
      const std::ptrdiff_t some = std::min(kAtOnce, count - first);
      const auto fraction = [count](std::ptrdiff_t k) {
        return static_cast<double>(k) / static_cast<double>(count);
      };
      parallelFor(some, partOfJob(job, fraction(first), fraction(first + some)), Phase::kAssemble,
                  [&](std::ptrdiff_t k) {
                    AveragedRows::Scratch scratch = pool.take();
                    blocks[k] = averaged_.blocks(averaged[first + k], totals, scratch);
                    pool.giveBack(std::move(scratch));
                  });
      // In the order of the elements, so that the sums do not depend on the number of threads.
      parallelFor(2, job, [&](std::ptrdiff_t half) {
        for (std::ptrdiff_t k = 0; k < some; ++k)
          addBlocks(averaged[first + k], blocks[k], half == 1, places[half]);
      });
    }
  }

  int columnOfSlot(int slot) const {
    return result_.nodeCount() + result_.order_.slotPositionOf[slot];
  }

  /// Columns of N: the functions of the near elements and of those left out.
  void setAveragedColumns(const Job& job) {
    BlockRows& N = result_.averaged_;
    const auto equations = static_cast<std::ptrdiff_t>(equations_.weights.rows());
    std::vector<std::vector<const AveragedElement*>> elements(static_cast<std::size_t>(equations));
    for (const AveragedElement& element : equations_.averaged)
      for (const int e : element.equations) elements[e].push_back(&element);
    std::vector<std::vector<int>> columns(static_cast<std::size_t>(equations));
    struct Marks {
      std::vector<int> elementMark, columnMark;
    };
    const std::size_t columnCount = nodes_.size() + result_.order_.slots.size();
    ScratchPool<Marks> pool([&] {
      return Marks{std::vector<int>(static_cast<std::size_t>(surface_.elementCount()), -1),
                   std::vector<int>(columnCount, -1)};
    });
    constexpr std::ptrdiff_t kPerTask = 64;
    parallelFor((equations + kPerTask - 1) / kPerTask, job, [&](std::ptrdiff_t task) {
      Marks marks = pool.take();
      for (std::ptrdiff_t e = task * kPerTask; e < std::min(equations, (task + 1) * kPerTask);
           ++e) {
        std::vector<int>& list = columns[e];
        const auto addAll = [&](std::span<const int> some) {
          for (const int element : some) {
            if (marks.elementMark[element] == e) continue;
            marks.elementMark[element] = static_cast<int>(e);
            const auto add = [&](int column) {
              if (marks.columnMark[column] == e) return;
              marks.columnMark[column] = static_cast<int>(e);
              list.push_back(column);
            };
            for (const int node : surface_.coefficients(element)) add(tree().positionOf()[node]);
            for (const int slot : surface_.slots(element)) add(columnOfSlot(slot));
          }
        };
        for (const AveragedElement* element : elements[e]) {
          addAll(element->near);
          for (const int node : element->nodes)
            addAll(averaged_.leftOut(static_cast<std::size_t>(node)));
        }
        std::sort(list.begin(), list.end());
      }
      pool.giveBack(std::move(marks));
    });
    N.begin.assign(1, 0);
    for (const auto& list : columns) N.begin.push_back(N.begin.back() + list.size());
    N.columns.reserve(N.begin.back());
    for (auto& list : columns) {
      N.columns.insert(N.columns.end(), list.begin(), list.end());
      list = {};
    }
  }

  void addBlocks(const AveragedElement& element, const AveragedRows::Blocks& blocks, bool isOfSlots,
                 std::vector<std::size_t>& places) {
    BlockRows& N = result_.averaged_;
    const std::vector<int>& functions = isOfSlots ? blocks.slots : blocks.coefficients;
    const MatrixXd& from = isOfSlots ? blocks.G : blocks.H;
    const double sign = isOfSlots ? 1 : -1;
    for (std::size_t k = 0; k < element.equations.size(); ++k) {
      const auto e = static_cast<std::size_t>(element.equations[k]);
      for (std::size_t b = N.begin[e]; b < N.begin[e + 1]; ++b) places[N.columns[b]] = b;
      for (std::size_t f = 0; f < functions.size(); ++f) {
        const int column =
            isOfSlots ? columnOfSlot(functions[f]) : tree().positionOf()[functions[f]];
        std::array<float, 9>& block = N.blocks[places[column]];
        for (int i = 0; i < 3; ++i)
          for (int c = 0; c < 3; ++c)
            block[3 * i + c] += static_cast<float>(
                sign * from(3 * static_cast<Index>(k) + i, 3 * static_cast<Index>(f) + c));
      }
    }
  }

  const ElementSurface& surface_;
  const ElementQuadrature& quadrature_;
  const WeightedEquations& equations_;
  const std::vector<Vector3d>& nodes_;
  const TractionSlots& slots_;
  const float tolerance_;
  const Job& job_;
  const ElementRows rowsOfSurface_;
  const KelvinConstants constants_;
  const AveragedRows averaged_;
  const double forceScale_;  ///< makes kernels of forces and dislocations comparable
  std::optional<ExactRows> exact_;
  std::vector<Ball> pointBalls_, functionBalls_;
  std::vector<std::vector<int>> farPairs_, nearPairs_;  ///< columns per row cluster
  std::vector<int> leafOfPoint_;
  CompressedOperators result_;
};

CompressedOperators assembleCompressed(const ElementSurface& surface,
                                       const ElementQuadrature& quadrature,
                                       const WeightedEquations& equations,
                                       const std::vector<Vector3d>& nodes,
                                       const TractionSlots& slots, const Material& material,
                                       double tolerance, const Job& job) {
  material.validate();
  return CompressedAssembly(surface, quadrature, equations, nodes, slots, material, tolerance, job)
      .run();
}

}  // namespace palpa::bem
