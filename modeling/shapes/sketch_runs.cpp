// Runs of a sketched curve: growth at the end, seam, division and joining.
#include <algorithm>

#include "modeling/shapes/profile_sketch.h"
#include "modeling/shapes/sketch_knots.h"

namespace palpa::modeling {

using Eigen::Vector2d;

void ProfileSketch::append(const Vector2d& at, SketchPointKind kind) {
  if (closed_) return;
  points_.push_back({at, kind});
  if (pointCount() < 2) return;
  const bool continues = pointCount() > 2 && !isOnCurve(pointCount() - 2);
  if (!continues) {
    knots_.emplace_back();
    return;
  }
  Knots& knots = knots_.back();
  const std::size_t needed =
      knotsNeeded(static_cast<int>(spline(runCount() - 1).points.size()) - 2, degree_);
  if (knots.size() >= needed) return;
  // One more span of the average length.
  const double spans = static_cast<double>(knots.size()) + 1.0;
  for (double& knot : knots) knot *= spans / (spans + 1.0);
  knots.push_back(spans / (spans + 1.0));
}

void ProfileSketch::close() {
  if (closed_ || pointCount() < 3) return;
  const bool firstWasCorner = points_.front().kind != SketchPointKind::kControl;
  const bool lastWasCorner = points_.back().kind != SketchPointKind::kControl;
  points_.front().kind = points_.back().kind = SketchPointKind::kCorner;
  closed_ = true;
  if (points_.back().at == points_.front().at && pointCount() > 3) {
    points_.pop_back();
    return;
  }
  knots_.emplace_back();
  if (!lastWasCorner) join(pointCount() - 1);
  if (firstWasCorner) return;
  const std::vector<int> starts = runStarts();
  if (starts.size() > 1) {
    rotateSeam(starts[1]);
    // The old first point is now the point on the curve before the end.
    join(runStarts().back());
  } else {
    makeSeamSmooth();
  }
}

void ProfileSketch::makeSeamSmooth() {
  // All points are control points of a periodic spline. It begins at a knot; with uniform knots
  // and degree 3 the point on the curve and its neighbours there are known in closed form.
  const int count = pointCount();
  if (degree_ == 3 && isUniform(knots_.front())) {
    const Vector2d before = points_[count - 1].at, at = points_[0].at, after = points_[1].at;
    points_[0] = {(before + 4.0 * at + after) / 6.0, SketchPointKind::kSmooth};
    points_.insert(points_.begin() + 1,
                   SketchPoint{(2.0 * at + after) / 3.0, SketchPointKind::kControl});
    points_.push_back({(before + 2.0 * at) / 3.0, SketchPointKind::kControl});
    knots_.front() = uniformKnots(knotsNeeded(pointCount() - 1, degree_));
    return;
  }
  points_[0].kind = SketchPointKind::kSmooth;
  align(0, -1);
}

void ProfileSketch::open() {
  if (!closed_) return;
  const bool closesStraight = isOnCurve(pointCount() - 1);
  closed_ = false;
  points_.front().kind = SketchPointKind::kCorner;
  if (closesStraight)
    knots_.pop_back();
  else
    points_.push_back(points_.front());
}

void ProfileSketch::rotateSeam(int point) {
  const int run = runOf(point);
  std::rotate(points_.begin(), points_.begin() + point, points_.end());
  std::rotate(knots_.begin(), knots_.begin() + run, knots_.end());
}

int ProfileSketch::join(int point) {
  if (closed_ && point == 0) {
    const std::vector<int> starts = runStarts();
    rotateSeam(starts[1]);
    point = runStarts().back();
  }
  const int after = runOf(point), before = after - 1;
  points_[point].kind = SketchPointKind::kControl;
  Knots knots;
  for (double knot : knots_[before]) knots.push_back(0.5 * knot);
  for (double knot : knots_[after]) knots.push_back(0.5 + 0.5 * knot);
  // Equal spans if both runs had them.
  if (isUniform(knots_[before]) && isUniform(knots_[after])) knots.clear();
  knots_[before].clear();
  knots_.erase(knots_.begin() + after);
  const std::size_t needed =
      knotsNeeded(static_cast<int>(spline(before).points.size()) - 2, degree_);
  if (knots.empty()) knots = uniformKnots(needed);
  thinTo(knots, needed, 0.5);
  fillTo(knots, needed);
  knots_[before] = std::move(knots);
  return point;
}

void ProfileSketch::split(int point) {
  const int run = runOf(point);
  const std::vector<int> starts = runStarts();
  const int innerBefore = point - starts[run] - 1;
  const int inner = static_cast<int>(spline(run).points.size()) - 2;
  const Knots old = knots_[run];
  const std::size_t first = knotsNeeded(innerBefore, degree_);
  const std::size_t second = knotsNeeded(inner - innerBefore - 1, degree_);
  const double low = first > 0 ? old[first - 1] : 0.0;
  const double high = second > 0 ? old[old.size() - second] : 1.0;
  const double middle = 0.5 * (low + high);
  Knots before(old.begin(), old.begin() + static_cast<std::ptrdiff_t>(first));
  Knots after(old.end() - static_cast<std::ptrdiff_t>(second), old.end());
  for (double& knot : before) knot /= middle;
  for (double& knot : after) knot = (knot - middle) / (1.0 - middle);
  points_[point].kind = SketchPointKind::kCorner;
  knots_[run] = std::move(before);
  knots_.insert(knots_.begin() + run + 1, std::move(after));
}

void ProfileSketch::align(int point, int fixedNeighbour) {
  const int before = previous(point), after = next(point);
  if (isOnCurve(before) || isOnCurve(after) || before == after) return;
  const Vector2d at = points_[point].at;
  const Vector2d in = points_[before].at - at, out = points_[after].at - at;
  Vector2d direction = out.normalized() - in.normalized();
  if (fixedNeighbour == after) direction = out;
  if (fixedNeighbour == before) direction = -in;
  // Opposite tangents have no mean: then the curve turns at a right angle to them.
  if (direction.norm() < 1e-9) direction = Vector2d(-out.y(), out.x());
  if (!(direction.norm() > 0.0)) return;
  direction.normalize();
  points_[after].at = at + out.norm() * direction;
  points_[before].at = at - in.norm() * direction;
}

}  // namespace palpa::modeling
