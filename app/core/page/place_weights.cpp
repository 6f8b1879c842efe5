#include "app/core/page/place_weights.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace palpa::app {

using Eigen::Index;

namespace {

/// Keeps places with almost the same mask, on both sides of a sharp edge, from large forces against
/// each other. Relative to the mean of the diagonal; 1e-4 has the same errors.
constexpr double kRidge = 1e-6;

std::vector<std::size_t> nearest(const OrientedPoint& point, std::span<const OrientedPoint> places,
                                 double scale) {
  std::vector<double> distance(places.size());
  for (std::size_t k = 0; k < places.size(); ++k)
    distance[k] = orientedDistance(point, places[k], scale);
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::size_t count = std::min(PlaceWeights::kCount, places.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
                    [&](std::size_t a, std::size_t b) {
                      return distance[a] != distance[b] ? distance[a] < distance[b] : a < b;
                    });
  order.resize(count);
  return order;
}

}  // namespace

Eigen::Matrix3d PlaceWeights::at(std::size_t k) const {
  Eigen::Matrix3d matrix;
  for (std::size_t i = 0; i < 9; ++i)
    matrix(static_cast<Index>(i / 3), static_cast<Index>(i % 3)) =
        static_cast<double>(scale) * numbers[9 * k + i];
  return matrix;
}

PlaceWeights placeWeights(const OrientedPoint& point, std::span<const OrientedPoint> places,
                          double scale, const Eigen::MatrixXd& between,
                          const Eigen::Ref<const Eigen::MatrixXd>& toPoint) {
  const std::vector<std::size_t> used = nearest(point, places, scale);
  const auto size = 3 * static_cast<Index>(used.size());
  Eigen::MatrixXd compliance(size, size), toPlaces(size, 3);
  for (std::size_t i = 0; i < used.size(); ++i) {
    const Index row = 3 * static_cast<Index>(i), from = 3 * static_cast<Index>(used[i]);
    toPlaces.middleRows<3>(row) = toPoint.middleCols<3>(from).transpose();
    for (std::size_t k = 0; k < used.size(); ++k)
      compliance.block<3, 3>(row, 3 * static_cast<Index>(k)) =
          between.block<3, 3>(from, 3 * static_cast<Index>(used[k]));
  }
  compliance.diagonal().array() += kRidge * compliance.trace() / static_cast<double>(size);
  const Eigen::MatrixXd forces = compliance.ldlt().solve(toPlaces);

  constexpr double kLargest = 32767;
  PlaceWeights weights;
  // Rounding up the scale to single precision must not make a number larger than 16 bits.
  weights.scale = static_cast<float>(forces.cwiseAbs().maxCoeff() / kLargest * (1 + 1e-6));
  for (std::size_t k = 0; k < used.size(); ++k) {
    weights.places[k] = static_cast<std::uint16_t>(used[k]);
    for (std::size_t i = 0; i < 9 && weights.scale > 0; ++i)
      weights.numbers[9 * k + i] = static_cast<std::int16_t>(std::lround(
          forces(3 * static_cast<Index>(k) + static_cast<Index>(i / 3), static_cast<Index>(i % 3)) /
          weights.scale));
  }
  return weights;
}

}  // namespace palpa::app
