#include "modeling/shapes/sketch_picking.h"

#include <algorithm>
#include <cmath>

#include "base/round_number.h"

namespace palpa::modeling {

using Eigen::Vector2d;

int nearestSketchPoint(const ProfileSketch& sketch, const Vector2d& at, double reach) {
  int nearest = -1;
  double best = reach;
  for (int i = 0; i < sketch.pointCount(); ++i) {
    const double distance = (sketch.points()[i].at - at).norm();
    const bool isTie = nearest >= 0 && distance == best;
    if (distance > best || (isTie && (sketch.isOnCurve(nearest) || !sketch.isOnCurve(i)))) continue;
    nearest = i;
    best = distance;
  }
  return nearest;
}

std::optional<SketchPlace> nearestSketchPlace(const std::vector<SketchPlace>& samples,
                                              const Vector2d& at, double reach) {
  std::optional<SketchPlace> nearest;
  double best = reach;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const Vector2d from = samples[i - 1].at, along = samples[i].at - from;
    const double length = along.squaredNorm();
    const double share = length > 0.0 ? std::clamp(along.dot(at - from) / length, 0.0, 1.0) : 0.0;
    const Vector2d foot = from + share * along;
    const double distance = (foot - at).norm();
    if (distance > best) continue;
    best = distance;
    // The first sample of a run belongs to the run before.
    const double begin = samples[i - 1].run == samples[i].run ? samples[i - 1].u : 0.0;
    nearest = SketchPlace{samples[i].run, begin + share * (samples[i].u - begin), foot};
  }
  return nearest;
}

Snapped snapped(const Vector2d& at, const SnapRules& rules) {
  Snapped result{at, false, {}, {}};
  double best = rules.reach;
  for (const Vector2d& point : rules.points) {
    const double distance = (point - at).norm();
    if (distance > best) continue;
    best = distance;
    result.at = point;
    result.toPoint = true;
  }
  if (result.toPoint) return result;
  for (int axis = 0; axis < 2; ++axis) {
    double& value = result.at[axis];
    const double original = value;
    if (rules.toAxes && std::abs(original) <= rules.reach) {
      value = 0.0;
      result.toLine[axis] = true;
      continue;
    }
    double nearest = rules.reach;
    for (const Vector2d& point : rules.points) {
      if (std::abs(point[axis] - original) > nearest) continue;
      nearest = std::abs(point[axis] - original);
      value = point[axis];
      result.toLine[axis] = true;
    }
    if (result.toLine[axis] || !(rules.gridStep > 0.0)) continue;
    value = std::round(original / rules.gridStep) * rules.gridStep + 0.0;
    result.toGrid[axis] = true;
  }
  return result;
}

double gridStep(double least, double unit) {
  return unit * roundedUp(least / unit);
}

}  // namespace palpa::modeling
