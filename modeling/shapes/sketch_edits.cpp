// Editing of a sketched curve.
#include <algorithm>
#include <cmath>
#include <set>

#include "modeling/shapes/bezier.h"
#include "modeling/shapes/profile_sketch.h"
#include "modeling/shapes/sketch_knots.h"

namespace palpa::modeling {

using Eigen::Vector2d;

void ProfileSketch::move(const std::vector<int>& points, const Vector2d& by) {
  const std::set<int> moved(points.begin(), points.end());
  for (int point : moved) points_.at(point).at += by;
  for (int i = 0; i < pointCount(); ++i) {
    if (points_[i].kind != SketchPointKind::kSmooth ||
        (!closed_ && (i == 0 || i + 1 == pointCount())))
      continue;
    const int before = previous(i), after = next(i);
    const bool first = moved.count(before) > 0, second = moved.count(after) > 0;
    if (moved.count(i) > 0) {
      for (int neighbour : {before, after})
        if (!isOnCurve(neighbour) && moved.count(neighbour) == 0) points_[neighbour].at += by;
    } else if (first != second) {
      align(i, first ? before : after);
    } else if (first) {
      align(i, -1);
    }
  }
}

int ProfileSketch::insert(const SketchPlace& place) {
  const int start = runStarts().at(place.run);
  Spline piece = spline(place.run);
  const auto put = [&](std::size_t inner) {
    const auto begin = points_.begin() + start + 1;
    points_.erase(begin, begin + static_cast<std::ptrdiff_t>(inner));
    std::vector<SketchPoint> fresh;
    for (std::size_t i = 1; i + 1 < piece.points.size(); ++i)
      fresh.push_back({piece.points[i], SketchPointKind::kControl});
    points_.insert(points_.begin() + start + 1, fresh.begin(), fresh.end());
  };
  const std::size_t inner = piece.points.size() - 2;
  if (inner == 0) {
    points_.insert(points_.begin() + start + 1,
                   SketchPoint{at(place.run, place.u), SketchPointKind::kCorner});
    knots_.insert(knots_.begin() + place.run, Knots{});
    return start + 1;
  }
  if (piece.basis.degree < degree_) {
    piece.points = elevatedOnce(piece.points);
    put(inner);
  } else {
    double u = std::clamp(place.u, 0.0, 1.0);
    const auto& knots = piece.basis.knots;
    for (std::size_t i = 1; i < knots.size(); ++i)
      if (knots[i] > knots[i - 1] && u >= knots[i - 1] && u <= knots[i]) {
        const double margin = 1e-3 * (knots[i] - knots[i - 1]);
        u = std::clamp(u, knots[i - 1] + margin, knots[i] - margin);
        break;
      }
    insertKnot(piece.basis, piece.points, u);
    knots_[place.run].assign(piece.basis.knots.begin() + degree_ + 1,
                             piece.basis.knots.end() - degree_ - 1);
    put(inner);
  }
  int nearest = start + 1;
  for (std::size_t i = 0; i + 2 < piece.points.size(); ++i) {
    const int candidate = start + 1 + static_cast<int>(i);
    if ((points_[candidate].at - place.at).norm() < (points_[nearest].at - place.at).norm())
      nearest = candidate;
  }
  return nearest;
}

void ProfileSketch::makeCorner(int point) {
  if (isOnCurve(point))
    points_[point].kind = SketchPointKind::kCorner;
  else
    split(point);
}

void ProfileSketch::makeSmooth(int point) {
  const bool isEnd = !closed_ && (point == 0 || point + 1 == pointCount());
  if (isEnd) {
    points_.at(point).kind = SketchPointKind::kControl;
  } else if (!isOnCurve(point)) {
    return;
  } else if (runCount() > 1) {
    join(point);
  } else {
    points_[point].kind = SketchPointKind::kSmooth;
    align(point, -1);
  }
}

void ProfileSketch::remove(std::vector<int> points) {
  std::sort(points.begin(), points.end(), std::greater<>());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  for (int point : points) removeOne(point);
}

void ProfileSketch::removeOne(int point) {
  if (closed_ && pointCount() <= 3) {
    open();
    if (pointCount() > 3) removeOne(pointCount() - 1);
  }
  const bool isEnd = !closed_ && (point == 0 || point + 1 == pointCount());
  if (isEnd) {
    // The neighbour becomes the end.
    if (pointCount() <= 2) {
      points_.erase(points_.begin() + point);
      knots_.clear();
      return;
    }
    const int neighbour = point == 0 ? 1 : point - 1;
    const bool wasInner = !isOnCurve(neighbour);
    const int run = point == 0 ? 0 : runCount() - 1;
    points_.erase(points_.begin() + point);
    if (wasInner) {
      const int inner = static_cast<int>(spline(run).points.size()) - 2;
      thinTo(knots_[run], knotsNeeded(inner, degree_), point == 0 ? 0.0 : 1.0);
    } else {
      knots_.erase(knots_.begin() + run);
    }
    return;
  }
  bool movesSeam = false;
  SketchPointKind kindOfSeam = SketchPointKind::kCorner;
  if (isOnCurve(point)) {
    const bool isOnlyOne = closed_ && runCount() == 1;
    kindOfSeam = points_.at(point).kind;
    if (isOnlyOne) split(1);  // the curve then begins at the next point
    point = join(point);
    movesSeam = isOnlyOne;
  }
  const int run = runOf(point);
  const int position = point - runStarts()[run];
  const int inner = static_cast<int>(spline(run).points.size()) - 2;
  points_.erase(points_.begin() + point);
  thinTo(knots_[run], knotsNeeded(inner - 1, degree_),
         static_cast<double>(position) / static_cast<double>(inner + 1));
  if (!movesSeam) return;
  points_[0].kind = kindOfSeam;
  if (kindOfSeam == SketchPointKind::kSmooth) align(0, -1);
}

void ProfileSketch::scale(const Vector2d& factors, const Vector2d& about) {
  for (SketchPoint& point : points_) point.at = about + factors.cwiseProduct(point.at - about);
}

bool ProfileSketch::addMirrorImage(int axis, double at, double tolerance) {
  if (closed_ || pointCount() < 2) return false;
  const auto isThere = [&](const SketchPoint& point) {
    return std::abs(point.at[axis] - at) <= tolerance;
  };
  bool atStart = isThere(points_.front());
  const bool atEnd = isThere(points_.back());
  if (!atStart && !atEnd) return false;
  if (!atEnd) {
    std::reverse(points_.begin(), points_.end());
    std::reverse(knots_.begin(), knots_.end());
    for (Knots& knots : knots_) {
      std::reverse(knots.begin(), knots.end());
      for (double& knot : knots) knot = 1.0 - knot;
    }
    atStart = false;
  }
  for (SketchPoint* end : {&points_.front(), &points_.back()}) end->kind = SketchPointKind::kCorner;
  points_.back().at[axis] = at;
  if (atStart) points_.front().at[axis] = at;
  const int last = pointCount() - 1, runs = runCount();
  for (int i = last - 1; i >= (atStart ? 1 : 0); --i) {
    SketchPoint image = points_[i];
    image.at[axis] = 2.0 * at - image.at[axis];
    points_.push_back(image);
  }
  for (int run = runs - 1; run >= 0; --run) {
    Knots image(knots_[run].rbegin(), knots_[run].rend());
    for (double& knot : image) knot = 1.0 - knot;
    knots_.push_back(std::move(image));
  }
  closed_ = atStart;
  return true;
}

}  // namespace palpa::modeling
