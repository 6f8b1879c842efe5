#include <algorithm>

#include "bem/quadratic/quadratic_surface.h"
#include "bem/quadratic/quartered_mesh.h"

// Places on a QuadraticSurface: of nodes, of points of the flat mesh, and of one point in all
// elements that contain it.

namespace palpa::bem {

using Eigen::Vector2d;
using Eigen::Vector3d;

ElementPlace QuadraticSurface::placeOf(int node, int element) const {
  const std::vector<int>& nodes = elements_[element].nodes;
  const auto k = std::find(nodes.begin(), nodes.end(), node) - nodes.begin();
  return {element, kQuadraticNodes[k][0], kQuadraticNodes[k][1]};
}

CollocationPlace QuadraticSurface::collocationAt(int node) const {
  CollocationPlace point{nodes_[node], {}};
  for (const int e : around_[node]) point.places.push_back(placeOf(node, e));
  return point;
}

ElementPlace QuadraticSurface::place(int triangle, const Vector3d& weights) {
  Vector2d at(0, 0);
  for (int corner = 0; corner < 3; ++corner)
    at += weights[corner] * kQuadraticNodes[kQuarters[triangle % 4][corner]];
  return {triangle / 4, at[0], at[1]};
}

std::pair<int, Vector3d> QuadraticSurface::quarter(const ElementPlace& place) {
  const double u = place.u, v = place.v, w = 1 - u - v;
  const int first = 4 * place.element;
  if (w >= 0.5) return {first, {2 * w - 1, 2 * u, 2 * v}};
  if (u >= 0.5) return {first + 1, {2 * w, 2 * u - 1, 2 * v}};
  if (v >= 0.5) return {first + 2, {2 * w, 2 * u, 2 * v - 1}};
  return {first + 3, {1 - 2 * v, 1 - 2 * w, 1 - 2 * u}};
}

CollocationPlace QuadraticSurface::placesAt(const ElementPlace& place) const {
  constexpr double kSlack = 1e-9;
  const std::array<double, 3> weights{1 - place.u - place.v, place.u, place.v};
  const std::vector<int>& nodes = elements_[place.element].nodes;
  for (int k = 0; k < 6; ++k)
    if ((Vector2d(place.u, place.v) - kQuadraticNodes[k]).lpNorm<Eigen::Infinity>() < kSlack) {
      CollocationPlace point = collocationAt(nodes[k]);
      std::stable_partition(point.places.begin(), point.places.end(),
                            [&](const ElementPlace& p) { return p.element == place.element; });
      return point;
    }
  CollocationPlace point{evaluate(place).position, {place}};
  for (int edge = 0; edge < 3; ++edge) {
    if (weights[(edge + 2) % 3] > kSlack) continue;
    // The same point in the element beyond the edge, with the corners the other way round.
    const int from = nodes[edge], to = nodes[(edge + 1) % 3];
    for (const int other : around_[nodes[3 + edge]]) {
      if (other == place.element) continue;
      const ElementPlace a = placeOf(from, other), b = placeOf(to, other);
      const double s = weights[(edge + 1) % 3];
      point.places.push_back({other, a.u + s * (b.u - a.u), a.v + s * (b.v - a.v)});
    }
  }
  return point;
}

}  // namespace palpa::bem
