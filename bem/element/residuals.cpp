#include "bem/element/residuals.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "base/part_of_job.h"
#include "base/scratch_pool.h"
#include "bem/element/element_rows.h"
#include "bem/element/kelvin_blocks.h"
#include "bem/element/skeleton.h"
#include "bem/linalg/blas_threads.h"

namespace palpa::bem {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector3d;

namespace {

constexpr int kPointsPerLeaf = 96, kElementsPerLeaf = 16;
constexpr double kTolerance = 1e-4;

/// Sums of the rows over elements, with the coefficients of the fields: ∫ U p - ∫ T u in the first
/// columns, ∫ T in the last three.
class FieldIntegrals {
 public:
  FieldIntegrals(const ElementSurface& surface, const ElementQuadrature& quadrature,
                 const KelvinConstants& constants, const BoundaryField& field)
      : surface_(surface), quadrature_(quadrature), constants_(constants), field_(field) {}

  Index columns() const { return field_.u.cols() + 3; }
  std::unique_ptr<ElementQuadrature::Workspace> makeWorkspace() const {
    return quadrature_.makeWorkspace();
  }

  /// Adds the integrals over one element to `sum`, 3 rows.
  void add(int element, const CollocationPlace& point, ElementQuadrature::Workspace& work,
           Matrix3Xd& sum) const {
    quadrature_.integrate(element, point.position, placeIn(point, element), work);
    const std::vector<int>&coefficients = surface_.coefficients(element),
          &slots = surface_.slots(element);
    const Index fields = field_.u.cols();
    Matrix3d T, U, total = Matrix3d::Zero();
    for (std::size_t f = 0; f < coefficients.size(); ++f) {
      const double* sums = work.sums[f].of;
      for (int c = 0; c < 3; ++c)
        for (int i = 0; i < 3; ++i) {
          T(i, c) = detail::BlockT::component(constants_, sums + kKernelSumsU, i, c);
          U(i, c) = detail::BlockU::component(constants_, sums, i, c);
        }
      sum.leftCols(fields) +=
          U.lazyProduct(field_.p.middleRows<3>(3 * static_cast<Index>(slots[f]))) -
          T.lazyProduct(field_.u.middleRows<3>(3 * static_cast<Index>(coefficients[f])));
      total += T;
    }
    sum.rightCols<3>() += total;
  }

 private:
  const ElementSurface& surface_;
  const ElementQuadrature& quadrature_;
  const KelvinConstants constants_;
  const BoundaryField& field_;
};

/// Clusters of points and of elements, and which pairs of them are distant. Sums at the points of a
/// cluster over its distant elements are computed for the rows of its skeleton and handed down to
/// its sons; near elements are summed at each point.
class PointClusters {
 public:
  PointClusters(std::span<const CollocationPlace> points, const ElementSurface& surface,
                const ElementQuadrature& quadrature, const Job& job)
      : points_(points) {
    for (const CollocationPlace& point : points) positions_.push_back(point.position);
    tree_ = ClusterTree(positions_, kPointsPerLeaf);
    std::vector<Vector3d> ordered;
    for (const int p : tree_.order()) ordered.push_back(positions_[p]);
    positions_ = std::move(ordered);
    const double least = 1e-9 * surface.boundingSize();
    for (int c = 0; c < tree_.count(); ++c) {
      const auto [begin, end] = tree_.cluster(c);
      balls_.push_back(ballAround(std::span(positions_).subspan(begin, end - begin)));
      balls_.back().radius = std::max(balls_.back().radius, least);
    }
    setElements(surface, quadrature);
    far_.resize(balls_.size());
    near_.resize(balls_.size());
    if (!points.empty()) divide(0, 0, job);
  }

  std::vector<Matrix3Xd> sums(const FieldIntegrals& integrals, const KelvinConstants& constants,
                              Phase phase, const Job& job) {
    setSkeletons(constants, partOfJob(job, 0, 0.2), phase);
    integrateAtSkeletons(integrals, partOfJob(job, 0.2, 0.6), phase);
    handDown();
    std::vector<Matrix3Xd> sums(positions_.size());
    const auto count = static_cast<std::ptrdiff_t>(positions_.size());
    ScratchPool<Workspace> pool([&] { return integrals.makeWorkspace(); });
    constexpr std::ptrdiff_t kPerTask = 8;
    parallelFor((count + kPerTask - 1) / kPerTask, partOfJob(job, 0.6, 1), phase,
                [&](std::ptrdiff_t task) {
                  Workspace work = pool.take();
                  for (std::ptrdiff_t k = task * kPerTask;
                       k < std::min(count, (task + 1) * kPerTask); ++k) {
                    const int leaf = tree_.leafOf(static_cast<int>(k)), p = tree_.order()[k];
                    Matrix3Xd& sum = sums[p];
                    sum = Matrix3Xd::Zero(3, integrals.columns());
                    if (ofRows_[leaf].size() > 0)
                      sum = ofRows_[leaf].middleRows<3>(3 * (k - tree_.cluster(leaf).begin));
                    for (const int e : near_[leaf]) integrals.add(e, points_[p], *work, sum);
                  }
                  pool.giveBack(std::move(work));
                });
    return sums;
  }

 private:
  using Workspace = std::unique_ptr<ElementQuadrature::Workspace>;
  struct Skeleton {
    std::vector<int> rows;  ///< 3 * (position in the tree) + i
    MatrixXd weights;       ///< (row of the sons' skeletons or of the leaf, row of the skeleton)
  };

  void setElements(const ElementSurface& surface, const ElementQuadrature& quadrature) {
    std::vector<Vector3d> middles;
    std::vector<std::vector<Vector3d>> ofElement(static_cast<std::size_t>(surface.elementCount()));
    for (int e = 0; e < surface.elementCount(); ++e) {
      const ElementPoints& rule = quadrature.keptPoints(e, ElementQuadrature::kKeptRules - 1);
      for (int k = 0; k < rule.used; ++k) ofElement[e].push_back(rule.positionOf(k));
      middles.push_back(ballAround(ofElement[e]).centre);
    }
    elements_ = ClusterTree(middles, kElementsPerLeaf);
    std::vector<Vector3d> places;
    for (int c = 0; c < elements_.count(); ++c) {
      places.clear();
      for (const int e : elementsOf(c))
        places.insert(places.end(), ofElement[e].begin(), ofElement[e].end());
      elementBalls_.push_back(ballAround(places));
    }
  }

  std::span<const int> elementsOf(int cluster) const {
    const auto [begin, end] = elements_.cluster(cluster);
    return std::span(elements_.order()).subspan(begin, end - begin);
  }

  void divide(int row, int column, const Job& job) {
    const bool isLeaf = tree_.isLeaf(row), isLeafOfElements = elements_.isLeaf(column);
    if (isLeaf) job.throwIfCancelled();
    if (tree_.cluster(row).size() == 0) return;
    const auto addTo = [&](std::vector<int>& list) {
      const std::span<const int> some = elementsOf(column);
      list.insert(list.end(), some.begin(), some.end());
    };
    if (isDistant(balls_[row], elementBalls_[column])) {
      addTo(far_[row]);
    } else if (isLeaf && isLeafOfElements) {
      addTo(near_[row]);
    } else if (isLeaf || (!isLeafOfElements && elementBalls_[column].radius > balls_[row].radius)) {
      for (int son = 2 * column + 1; son <= 2 * column + 2; ++son) divide(row, son, job);
    } else {
      for (int son = 2 * row + 1; son <= 2 * row + 2; ++son) divide(son, column, job);
    }
  }

  /// Skeletons from the leaves up to the first level with distant elements.
  void setSkeletons(const KelvinConstants& constants, const Job& job, Phase phase) {
    skeletons_.resize(balls_.size());
    const auto found = std::find_if(far_.begin(), far_.end(),
                                    [](const std::vector<int>& list) { return !list.empty(); });
    top_ = 0;
    while (top_ < tree_.levelCount() && ClusterTree::firstOf(top_ + 1) <= found - far_.begin())
      ++top_;
    for (int level = tree_.levelCount() - 1; level >= top_; --level) {
      const int first = ClusterTree::firstOf(level);
      const Job ofLevel = partOfJob(job, static_cast<std::size_t>(tree_.levelCount() - 1 - level),
                                    static_cast<std::size_t>(tree_.levelCount() - level),
                                    static_cast<std::size_t>(tree_.levelCount()));
      parallelFor(ClusterTree::countOf(level), ofLevel, phase, [&](std::ptrdiff_t k) {
        const int c = first + static_cast<int>(k);
        skeletons_[c] = skeletonOf(constants, c);
      });
    }
  }

  Skeleton skeletonOf(const KelvinConstants& constants, int cluster) const {
    std::vector<int> candidates;
    if (tree_.isLeaf(cluster)) {
      candidates.resize(3 * static_cast<std::size_t>(tree_.cluster(cluster).size()));
      std::iota(candidates.begin(), candidates.end(), 3 * tree_.cluster(cluster).begin);
    } else {
      for (int son = 2 * cluster + 1; son <= 2 * cluster + 2; ++son)
        candidates.insert(candidates.end(), skeletons_[son].rows.begin(),
                          skeletons_[son].rows.end());
    }
    const RowChoice choice =
        chooseSkeleton(constants, positions_, candidates, balls_[cluster], kTolerance);
    Skeleton skeleton;
    for (const int row : choice.rows) skeleton.rows.push_back(candidates[row]);
    skeleton.weights = choice.weights.cast<double>();
    return skeleton;
  }

  void integrateAtSkeletons(const FieldIntegrals& integrals, const Job& job, Phase phase) {
    ofSkeleton_.resize(balls_.size());
    // The rows of a point are computed together.
    struct Task {
      int cluster, point;
      std::vector<std::pair<int, int>> rows;  ///< of the skeleton, and its component
    };
    std::vector<Task> tasks;
    for (int c = 0; c < tree_.count(); ++c) {
      const std::vector<int>& rows = skeletons_[c].rows;
      ofSkeleton_[c] = MatrixXd::Zero(static_cast<Index>(rows.size()), integrals.columns());
      if (far_[c].empty()) continue;
      std::vector<std::pair<int, int>> byPoint;
      for (std::size_t k = 0; k < rows.size(); ++k)
        byPoint.emplace_back(rows[k], static_cast<int>(k));
      std::sort(byPoint.begin(), byPoint.end());
      for (const auto& [row, k] : byPoint) {
        if (tasks.empty() || tasks.back().cluster != c || tasks.back().point != row / 3)
          tasks.push_back({c, row / 3, {}});
        tasks.back().rows.emplace_back(k, row % 3);
      }
    }
    ScratchPool<Workspace> pool([&] { return integrals.makeWorkspace(); });
    parallelFor(static_cast<std::ptrdiff_t>(tasks.size()), job, phase, [&](std::ptrdiff_t t) {
      const Task& task = tasks[t];
      Workspace work = pool.take();
      Matrix3Xd sum = Matrix3Xd::Zero(3, integrals.columns());
      const CollocationPlace& point = points_[tree_.order()[task.point]];
      for (const int e : far_[task.cluster]) integrals.add(e, point, *work, sum);
      for (const auto& [row, i] : task.rows) ofSkeleton_[task.cluster].row(row) = sum.row(i);
      pool.giveBack(std::move(work));
    });
  }

  void handDown() {
    ofRows_.resize(balls_.size());
    for (int c = ClusterTree::firstOf(top_); c < tree_.count(); ++c) {
      const MatrixXd values = skeletons_[c].weights * ofSkeleton_[c];
      if (tree_.isLeaf(c)) {
        ofRows_[c] = values;
        continue;
      }
      Index first = 0;
      for (int son = 2 * c + 1; son <= 2 * c + 2; ++son) {
        ofSkeleton_[son] += values.middleRows(first, ofSkeleton_[son].rows());
        first += ofSkeleton_[son].rows();
      }
    }
  }

  std::span<const CollocationPlace> points_;
  ClusterTree tree_, elements_;
  std::vector<Vector3d> positions_;  ///< of the points, in the order of the tree
  std::vector<Ball> balls_, elementBalls_;
  std::vector<std::vector<int>> far_, near_;  ///< elements per cluster of points
  std::vector<Skeleton> skeletons_;
  std::vector<MatrixXd> ofSkeleton_, ofRows_;
  int top_ = 0;  ///< first level with distant elements
};

}  // namespace

std::vector<Matrix3Xd> residualsAt(std::span<const CollocationPlace> points,
                                   const ElementSurface& surface,
                                   const ElementQuadrature& quadrature, const Material& material,
                                   const BoundaryField& field, Phase phase, const Job& job) {
  useOneBlasThread();
  const KelvinConstants constants = ElementRows(surface, quadrature, material).constants();
  const FieldIntegrals integrals(surface, quadrature, constants, field);
  std::vector<Matrix3Xd> residuals =
      PointClusters(points, surface, quadrature, job).sums(integrals, constants, phase, job);
  std::vector<double> basis;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const ElementPlace& place = points[k].places.front();
    surface.evaluateBasis(place, basis);
    Matrix3Xd u = Matrix3Xd::Zero(3, field.u.cols());
    const std::vector<int>& coefficients = surface.coefficients(place.element);
    for (std::size_t f = 0; f < coefficients.size(); ++f)
      u += basis[f] * field.u.middleRows<3>(3 * static_cast<Index>(coefficients[f]));
    residuals[k] = residuals[k].leftCols(u.cols()) + residuals[k].rightCols<3>() * u;
  }
  return residuals;
}

}  // namespace palpa::bem
