#include "bem/element/element_equations.h"

#include "bem/model/element_part.h"

namespace palpa::bem {

WeightedEquations WeightedEquations::only(std::span<const int> equations) const {
  const std::vector<int> places = placesIn(equations, static_cast<int>(weights.rows()));
  WeightedEquations some;
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index p = 0; p < weights.cols(); ++p) {
    const std::size_t before = entries.size();
    for (Eigen::SparseMatrix<double>::InnerIterator w(weights, p); w; ++w)
      if (const int row = places[w.row()]; row >= 0)
        entries.emplace_back(row, static_cast<int>(some.points.size()), w.value());
    if (entries.size() > before) some.points.push_back(points[p]);
  }
  some.weights.resize(static_cast<Eigen::Index>(equations.size()),
                      static_cast<Eigen::Index>(some.points.size()));
  some.weights.setFromTriplets(entries.begin(), entries.end());
  return some;
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
