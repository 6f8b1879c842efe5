#include "bem/element/element_equations.h"

#include "bem/model/element_part.h"

namespace palpa::bem {

WeightedEquations WeightedEquations::only(std::span<const int> equations) const {
  const std::vector<int> places = placesIn(equations, static_cast<int>(weights.rows()));
  WeightedEquations some;
  std::vector<bool> isNode(points.size(), false);
  for (const AveragedElement& element : averaged) {
    std::vector<int> kept;
    for (std::size_t k = 0; k < element.equations.size(); ++k)
      if (places[element.equations[k]] >= 0) kept.push_back(static_cast<int>(k));
    if (kept.empty()) continue;
    AveragedElement& here = some.averaged.emplace_back(element);
    here.weights = element.weights(kept, Eigen::all);
    here.equations.clear();
    for (const int k : kept) here.equations.push_back(places[element.equations[k]]);
    for (const int node : element.nodes) isNode[node] = true;
  }
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<int> pointPlaces(points.size(), -1);
  for (Eigen::Index p = 0; p < weights.cols(); ++p) {
    const std::size_t before = entries.size();
    for (Eigen::SparseMatrix<double>::InnerIterator w(weights, p); w; ++w)
      if (const int row = places[w.row()]; row >= 0)
        entries.emplace_back(row, static_cast<int>(some.points.size()), w.value());
    if (entries.size() == before && !isNode[p]) continue;
    pointPlaces[p] = static_cast<int>(some.points.size());
    some.points.push_back(points[p]);
  }
  for (AveragedElement& element : some.averaged)
    for (int& node : element.nodes) node = pointPlaces[node];
  some.weights.resize(static_cast<Eigen::Index>(equations.size()),
                      static_cast<Eigen::Index>(some.points.size()));
  some.weights.setFromTriplets(entries.begin(), entries.end());
  return some;
}

void addPoints(const AveragedElement& element, std::vector<CollocationPlace>& points,
               std::vector<Eigen::Triplet<double>>& weights) {
  for (std::size_t q = 0; q < element.points.size(); ++q) {
    for (std::size_t e = 0; e < element.equations.size(); ++e)
      weights.emplace_back(
          element.equations[e], static_cast<int>(points.size()),
          element.weights(static_cast<Eigen::Index>(e), static_cast<Eigen::Index>(q)));
    points.push_back(element.points[q]);
  }
}

void setWeights(WeightedEquations& equations, Eigen::Index equationCount,
                std::vector<Eigen::Triplet<double>> weights) {
  for (const AveragedElement& element : equations.averaged) {
    const Eigen::MatrixXd ofNodes = element.weights * element.interpolated.transpose();
    for (std::size_t e = 0; e < element.equations.size(); ++e)
      for (std::size_t k = 0; k < element.nodes.size(); ++k)
        weights.emplace_back(element.equations[e], element.nodes[k],
                             ofNodes(static_cast<Eigen::Index>(e), static_cast<Eigen::Index>(k)));
  }
  equations.weights.resize(equationCount, static_cast<Eigen::Index>(equations.points.size()));
  equations.weights.setFromTriplets(weights.begin(), weights.end());
}

WeightedEquations atPoints(const WeightedEquations& equations) {
  WeightedEquations result;
  std::vector<Eigen::Triplet<double>> weights;
  std::vector<bool> isNode(equations.points.size(), false);
  for (const AveragedElement& element : equations.averaged)
    for (const int node : element.nodes) isNode[node] = true;
  for (std::size_t p = 0; p < equations.points.size(); ++p) {
    if (isNode[p]) continue;
    for (Eigen::SparseMatrix<double>::InnerIterator w(equations.weights,
                                                      static_cast<Eigen::Index>(p));
         w; ++w)
      weights.emplace_back(static_cast<int>(w.row()), static_cast<int>(result.points.size()),
                           w.value());
    result.points.push_back(equations.points[p]);
  }
  for (const AveragedElement& element : equations.averaged)
    addPoints(element, result.points, weights);
  result.weights.resize(equations.weights.rows(), static_cast<Eigen::Index>(result.points.size()));
  result.weights.setFromTriplets(weights.begin(), weights.end());
  return result;
}

WeightedEquations collocationEquations(std::vector<CollocationPlace> points) {
  WeightedEquations equations;
  equations.points = std::move(points);
  const auto count = static_cast<Eigen::Index>(equations.points.size());
  equations.weights.resize(count, count);
  equations.weights.setIdentity();
  return equations;
}

}  // namespace palpa::bem
