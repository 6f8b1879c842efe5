#include "bem/compressed/point_sums.h"

#include <map>
#include <numeric>
#include <utility>

namespace palpa::bem {

using Eigen::Index;
using Eigen::MatrixXf;
using Eigen::Vector3f;

namespace {

using Triplets = std::vector<Eigen::Triplet<float>>;

/// Points of rules, whose equations have no other use for a single point. The nodes of averaged
/// elements have one.
std::vector<char> pointsOfRules(const WeightedEquations& equations) {
  std::vector<char> isOfRule(equations.points.size());
  for (std::size_t p = 0; p < isOfRule.size(); ++p) {
    const bool hasSeveral = equations.weights.col(static_cast<Index>(p)).nonZeros() > 1;
    isOfRule[p] = hasSeveral ? 1 : 0;
  }
  for (const AveragedElement& element : equations.averaged)
    for (const int p : element.nodes) isOfRule[p] = 0;
  return isOfRule;
}

PointSums::Weights matrixOf(Index rows, Index columns, const Triplets& entries) {
  PointSums::Weights matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

PointSums::PointSums(const CompressedOrder& order, const WeightedEquations& equations)
    : order_(&order), rows_(order) {
  const std::vector<char> isOfRule = pointsOfRules(equations);
  using Column = Eigen::SparseMatrix<double>::InnerIterator;
  Triplets points, weights;
  int rows = 0;
  const auto addSingle = [&](int position) {
    points.emplace_back(rows, position, 1.0F);
    for (Column w(equations.weights, order.points[position]); w; ++w)
      if (w.value() != 0)
        weights.emplace_back(static_cast<int>(w.row()), rows, static_cast<float>(w.value()));
    ++rows;
  };
  for (int leaf = ClusterTree::firstOf(order.tree.levelCount() - 1); leaf < order.tree.count();
       ++leaf) {
    // By equation.
    std::map<int, std::vector<std::pair<int, float>>> sums;
    int summed = 0;
    for (int p = order.pointBegin(leaf); p < order.pointEnd(leaf); ++p) {
      if (!isOfRule[order.points[p]]) continue;
      ++summed;
      for (Column w(equations.weights, order.points[p]); w; ++w)
        if (w.value() != 0)
          sums[static_cast<int>(w.row())].emplace_back(p, static_cast<float>(w.value()));
    }
    const bool pays = static_cast<int>(sums.size()) < summed;
    const auto [begin, end] = order.tree.cluster(leaf);
    for (int position = begin; position < end; ++position) {
      rows_.firstPoint[position] = rows;
      for (int p = order.firstPoint[position]; p < order.firstPoint[position + 1]; ++p)
        if (!pays || !isOfRule[order.points[p]]) addSingle(p);
      // Where in the leaf is of no importance.
      if (position > begin || !pays) continue;
      for (const auto& [equation, parts] : sums) {
        for (const auto& [p, weight] : parts) points.emplace_back(rows, p, weight);
        weights.emplace_back(equation, rows, 1.0F);
        ++rows;
      }
    }
  }
  rows_.firstPoint.back() = rows;
  rows_.points.resize(static_cast<std::size_t>(rows));
  std::iota(rows_.points.begin(), rows_.points.end(), 0);
  rows_.pointPositionOf = rows_.points;
  points_ = matrixOf(rows, static_cast<Index>(order.points.size()), points);
  weights_ = matrixOf(equations.weights.rows(), rows, weights);
}

MatrixXf PointSums::sum(int leaf, MatrixXf ofPoints) const {
  const int firstRow = rows_.pointBegin(leaf), firstPoint = order_->pointBegin(leaf);
  const Index rows = rows_.rows(leaf);
  if (!hasSums(leaf)) return ofPoints;  // the rows are the points in the same order
  MatrixXf result = MatrixXf::Zero(rows, ofPoints.cols());
  for (Index c = 0; c < result.cols(); ++c)
    for (int row = firstRow; row < rows_.pointEnd(leaf); ++row)
      for (Weights::InnerIterator w(points_, row); w; ++w)
        result.col(c).segment<3>(3 * static_cast<Index>(row - firstRow)) +=
            w.value() * ofPoints.col(c).segment<3>(3 * (w.col() - firstPoint));
  return result;
}

}  // namespace palpa::bem
