#include "app/core/page/touch_places.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

}  // namespace palpa::app
