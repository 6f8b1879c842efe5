#include "app/core/page/touch_places.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace palpa::app {

using Eigen::Vector3d;

double orientedDistance(const OrientedPoint& a, const OrientedPoint& b, double scale) {
  return std::sqrt((a.position - b.position).squaredNorm() +
                   scale * scale * (a.normal - b.normal).squaredNorm());
}

std::vector<int> spreadPlaces(std::span<const OrientedPoint> points, int count, double scale) {
  std::vector<int> places;
  if (points.empty()) return places;
  Vector3d middle = Vector3d::Zero();
  for (const OrientedPoint& point : points)
    middle += point.position / static_cast<double>(points.size());
  std::vector<double> distance(points.size(), std::numeric_limits<double>::infinity());
  std::size_t next = 0;
  for (std::size_t k = 1; k < points.size(); ++k)
    if ((points[k].position - middle).squaredNorm() >
        (points[next].position - middle).squaredNorm())
      next = k;
  while (static_cast<int>(places.size()) < count) {
    places.push_back(static_cast<int>(next));
    const OrientedPoint chosen = points[next];
    for (std::size_t k = 0; k < points.size(); ++k)
      distance[k] = std::min(distance[k], orientedDistance(points[k], chosen, scale));
    next = static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) -
                                    distance.begin());
    if (!(distance[next] > 0)) break;
  }
  return places;
}

PlaceWeights weightsAt(const OrientedPoint& point, std::span<const OrientedPoint> places,
                       double scale) {
  std::vector<double> distance(places.size());
  for (std::size_t k = 0; k < places.size(); ++k)
    distance[k] = orientedDistance(point, places[k], scale);
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::size_t used = std::min(PlaceWeights::kCount, places.size());
  const std::size_t sorted = std::min(used + 1, places.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(sorted), order.end(),
                    [&](std::size_t a, std::size_t b) {
                      return distance[a] != distance[b] ? distance[a] < distance[b] : a < b;
                    });
  const double reach = sorted > used ? distance[order[used]] : 2 * distance[order[used - 1]];
  PlaceWeights result;
  for (std::size_t k = 0; k < used; ++k) result.places[k] = static_cast<std::uint16_t>(order[k]);
  if (!(distance[order[0]] > 1e-9 * reach)) {
    result.weights[0] = 1;
    return result;
  }
  const Vector3d along = point.normal.unitOrthogonal(), across = point.normal.cross(along);
  Eigen::Matrix4d moments = Eigen::Matrix4d::Zero();
  std::array<Eigen::Vector4d, PlaceWeights::kCount> basis;
  std::array<double, PlaceWeights::kCount> share{};
  for (std::size_t k = 0; k < used; ++k) {
    const double d = distance[order[k]] / reach;
    share[k] = std::pow(std::max(0.0, 1 - d) / d, 2);
    const Vector3d to = (places[order[k]].position - point.position) / reach;
    // Along the normal, too: on a bent surface a rotation is not linear in the tangent plane.
    basis[k] = {1, to.dot(along), to.dot(across), to.dot(point.normal)};
    moments += share[k] * basis[k] * basis[k].transpose();
  }
  // Keeps places on a line or in a plane, or on one side, from weights that are large and of both
  // signs.
  constexpr double kRidge = 3e-4;
  const double ridge = kRidge * moments(0, 0);
  moments.diagonal().tail<3>().array() += ridge;
  const Eigen::Vector4d factors = moments.ldlt().solve(Eigen::Vector4d::UnitX());
  double sum = 0;
  std::array<double, PlaceWeights::kCount> weights{};
  for (std::size_t k = 0; k < used; ++k) sum += weights[k] = share[k] * basis[k].dot(factors);
  for (std::size_t k = 0; k < used; ++k) result.weights[k] = static_cast<float>(weights[k] / sum);
  return result;
}

}  // namespace palpa::app
