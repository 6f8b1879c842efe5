#include "bem/spline/spline_nearest.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpa::bem {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kMaxSteps = 40, kMaxHalvings = 8;

/// Gauss-Newton step, projected onto the border where it would leave the element.
Vector2d boundedStep(const SplineElement& element, const Vector2d& from, Matrix2d normal,
                     const Vector2d& slope) {
  normal += 1e-14 * normal.trace() * Matrix2d::Identity();
  const auto clamp = [&](int d, double value) {
    return std::clamp(value, element.lower[d], element.upper[d]);
  };
  const Vector2d free = from + normal.inverse() * slope;
  Vector2d to(clamp(0, free[0]), clamp(1, free[1]));
  for (int d = 0; d < 2; ++d)
    if (to[d] != free[d]) {
      const int other = 1 - d;
      const double left = slope[other] - normal(other, d) * (to[d] - from[d]);
      if (normal(other, other) > 0)
        to[other] = clamp(other, from[other] + left / normal(other, other));
    }
  return to - from;
}

bool isOnBorder(const SplinePatch& patch, const Vector2d& parameters) {
  for (int d = 0; d < 2; ++d) {
    const auto& knots = patch.basis[d].knots();
    const double slack = 1e-9 * (knots.back() - knots.front());
    if (parameters[d] <= knots.front() + slack || parameters[d] >= knots.back() - slack)
      return true;
  }
  return false;
}

}  // namespace

ElementFoot nearestOnElement(const SplineSurface& surface, int index, const Vector3d& x) {
  const SplineElement& element = surface.elements()[index];
  const Vector2d lower(element.lower[0], element.lower[1]),
      upper(element.upper[0], element.upper[1]);
  const auto jetAt = [&](const Vector2d& local) {
    return surface.evaluate({index, local[0], local[1]});
  };
  // Where the coordinate is the root of the distance, the iteration cannot leave the border.
  constexpr double kFromBorder = 0.2;
  const std::array<double, 3> starts{surface.isCut(index) ? kFromBorder : 0.0, 0.5,
                                     surface.isCut(index) ? 1 - kFromBorder : 1.0};
  Vector2d at = lower;
  double distance = std::numeric_limits<double>::infinity();
  for (const double s : starts)
    for (const double t : starts) {
      const Vector2d local = lower + Vector2d(s, t).cwiseProduct(upper - lower);
      const double found = (jetAt(local).position - x).norm();
      if (found >= distance) continue;
      distance = found;
      at = local;
    }
  for (int step = 0; step < kMaxSteps; ++step) {
    const SurfaceJet jet = jetAt(at);
    Eigen::Matrix<double, 3, 2> tangents;
    tangents << jet.du, jet.dv;
    Vector2d move = boundedStep(element, at, tangents.transpose() * tangents,
                                tangents.transpose() * (x - jet.position));
    double found = (jetAt(at + move).position - x).norm();
    for (int half = 0; half < kMaxHalvings && !(found < distance); ++half) {
      move /= 2;
      found = (jetAt(at + move).position - x).norm();
    }
    if (!(found < distance)) break;
    at += move;
    distance = found;
    if (move.cwiseQuotient(upper - lower).lpNorm<Eigen::Infinity>() < 1e-12) break;
  }
  return {{index, at[0], at[1]}, distance};
}

CollocationPlace surfacePlaces(const SplineSurface& surface, const SplineMesh::Point& at) {
  const int patch = surface.elements()[at.element].patch;
  CollocationPlace point;
  point.places = placesInPatch(surface, patch, at.parameters[0], at.parameters[1]);
  std::stable_partition(point.places.begin(), point.places.end(),
                        [&](const ElementPlace& place) { return place.element == at.element; });
  const ElementPlace own = point.places.front();
  point.position = surface.evaluate(own).position;
  if (!isOnBorder(surface.patches()[patch], at.parameters)) return point;

  // Elements that meet at the point share the coefficient with the largest weight.
  std::vector<double> basis;
  surface.evaluateNet(own.element, at.parameters, basis);
  const auto heaviest = std::max_element(basis.begin(), basis.end()) - basis.begin();
  const int wanted = surface.tornFrom(surface.net(own.element)[heaviest]);
  const double slack = 1e-9 * surface.boundingSize();
  for (int e = 0; e < surface.elementCount(); ++e) {
    const std::vector<int>& list = surface.net(e);
    if (std::none_of(list.begin(), list.end(),
                     [&](int k) { return surface.tornFrom(k) == wanted; }) ||
        std::any_of(point.places.begin(), point.places.end(),
                    [e](const ElementPlace& place) { return place.element == e; }))
      continue;
    const ElementFoot foot = nearestOnElement(surface, e, point.position);
    if (foot.distance <= slack) point.places.push_back(foot.place);
  }
  return point;
}

}  // namespace palpa::bem
