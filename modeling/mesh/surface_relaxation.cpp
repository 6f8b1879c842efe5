// Moves nodes along the surface (SurfaceEditor::relax()).
#include <algorithm>
#include <cmath>

#include "modeling/mesh/surface_editor.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

constexpr double kGoodAngleCosine = 0.82;  // of 35°: stars with larger angles need no relaxing

}  // namespace

bool SurfaceEditor::tryMove(int node, const Vector3d& there) {
  if (!starStays(node, there)) return false;
  const double before = worstAngleCosine(node);
  const Vector3d old = positions_[node];
  positions_[node] = there;
  if (worstAngleCosine(node) > std::max(before, kGoodAngleCosine)) {
    positions_[node] = old;
    return false;
  }
  sizes_[node] = field_.at(there);
  return true;
}

/// Mean of the centres of the surrounding triangles, weighted by area over the fourth power of the
/// wanted size (density of a centroidal Voronoi diagram), so that nodes are denser at finer places.
/// The node moves along the surface only.
Vector3d SurfaceEditor::relaxedInside(int node) const {
  Vector3d sum = Vector3d::Zero();
  Vector3d direction = Vector3d::Zero();
  double weights = 0.0;
  for (int t : around_[node]) {
    const auto& n = triangles_[t];
    const Vector3d areaVector = normal(n);
    const double size = (sizes_[n[0]] + sizes_[n[1]] + sizes_[n[2]]) / 3.0;
    const double weight = areaVector.norm() / (size * size * size * size);
    sum += weight / 3.0 * (positions_[n[0]] + positions_[n[1]] + positions_[n[2]]);
    weights += weight;
    direction += areaVector;
  }
  if (weights == 0.0 || direction.norm() == 0.0) return positions_[node];
  direction.normalize();
  const Vector3d step = sum / weights - positions_[node];
  return positions_[node] + step - direction * direction.dot(step);
}

bool SurfaceEditor::relax(int node) {
  if (around_[node].empty() || corner_[node]) return false;
  const std::vector<int> rails = featureNeighbours(node);
  if (!rails.empty()) {
    // The place where both adjacent edges have the same length relative to the wanted sizes.
    const double first = relativeLength(node, rails[0]);
    const double second = relativeLength(node, rails[1]);
    const int to = first > second ? rails[0] : rails[1];
    const double part = std::abs(first - second) / (2.0 * std::max(first, second));
    const Vector3d wanted = positions_[node] + part * (positions_[to] - positions_[node]);
    const Vector3d there = onOriginal(node, to, wanted);
    return (there - wanted).norm() < kFarOff * length(node, to) && tryMove(node, there);
  }
  const Vector3d wanted = relaxedInside(node);
  const Vector3d there = original_.onRegion(tags_[around_[node].front()].region, wanted);
  if ((there - wanted).norm() > kFarOff * sizes_[node]) return false;
  return tryMove(node, there);
}

}  // namespace palpa::modeling
