// Drawing and editing of a sketched curve.
#include <Geom2d_BSplineCurve.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <algorithm>
#include <cmath>
#include <set>

#include "modeling/shapes/bezier.h"
#include "modeling/shapes/profile_sketch.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector2d;

std::size_t knotsNeeded(int innerPoints, int degree) {
  return static_cast<std::size_t>(std::max(0, innerPoints + 1 - degree));
}

/// Inserts knots in the middle of the widest spans until there are `count`.
void fillTo(std::vector<double>& knots, std::size_t count) {
  while (knots.size() < count) {
    double low = 0.0, best = 0.0, width = -1.0;
    for (std::size_t i = 0; i <= knots.size(); ++i) {
      const double high = i < knots.size() ? knots[i] : 1.0;
      if (high - low > width * (1.0 + 1e-9)) {
        width = high - low;
        best = 0.5 * (low + high);
      }
      low = high;
    }
    knots.insert(std::upper_bound(knots.begin(), knots.end(), best), best);
  }
}

/// Removes one of the knots nearest to a parameter until there are `count`.
void thinTo(std::vector<double>& knots, std::size_t count, double near) {
  while (knots.size() > count)
    knots.erase(std::min_element(knots.begin(), knots.end(), [&](double a, double b) {
      return std::abs(a - near) < std::abs(b - near);
    }));
}

bool isUniform(const std::vector<double>& knots) {
  const double spans = static_cast<double>(knots.size()) + 1.0;
  for (std::size_t i = 0; i < knots.size(); ++i)
    if (std::abs(knots[i] - static_cast<double>(i + 1) / spans) > 1e-9) return false;
  return true;
}

/// The same spline with a knot more.
void insertKnot(SplineBasis& basis, std::vector<Vector2d>& points, double u) {
  std::vector<double> distinct;
  std::vector<int> multiplicity;
  for (double knot : basis.knots) {
    if (distinct.empty() || knot > distinct.back()) {
      distinct.push_back(knot);
      multiplicity.push_back(0);
    }
    ++multiplicity.back();
  }
  const int count = static_cast<int>(distinct.size());
  TColgp_Array1OfPnt2d poles(1, static_cast<int>(points.size()));
  for (int i = 1; i <= poles.Length(); ++i)
    poles.SetValue(i, gp_Pnt2d(points[i - 1].x(), points[i - 1].y()));
  TColStd_Array1OfReal knots(1, count);
  TColStd_Array1OfInteger times(1, count);
  for (int i = 1; i <= count; ++i) {
    knots.SetValue(i, distinct[i - 1]);
    times.SetValue(i, multiplicity[i - 1]);
  }
  Geom2d_BSplineCurve curve(poles, knots, times, basis.degree);
  curve.InsertKnot(u, 1, 0.0);
  points.clear();
  for (int i = 1; i <= curve.NbPoles(); ++i)
    points.emplace_back(curve.Pole(i).X(), curve.Pole(i).Y());
  basis.knots.insert(std::upper_bound(basis.knots.begin(), basis.knots.end(), u), u);
}

}  // namespace

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
    const std::size_t needed = knotsNeeded(pointCount() - 1, degree_);
    knots_.front().clear();
    for (std::size_t i = 1; i <= needed; ++i)
      knots_.front().push_back(static_cast<double>(i) / static_cast<double>(needed + 1));
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
  if (knots.empty())
    for (std::size_t i = 1; i <= needed; ++i)
      knots.push_back(static_cast<double>(i) / static_cast<double>(needed + 1));
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
