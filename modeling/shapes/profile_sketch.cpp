#include "modeling/shapes/profile_sketch.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "modeling/shapes/bezier.h"
#include "modeling/shapes/profile_check.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector2d;

SplineBasis basisOver(int degree, const std::vector<double>& inner) {
  SplineBasis basis{degree, std::vector<double>(static_cast<std::size_t>(degree) + 1, 0.0)};
  basis.knots.insert(basis.knots.end(), inner.begin(), inner.end());
  basis.knots.insert(basis.knots.end(), static_cast<std::size_t>(degree) + 1, 1.0);
  return basis;
}

bool isStraight(const std::vector<Vector2d>& points, double tolerance) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(points.size() - 1);
    const Vector2d onLine = (1.0 - share) * points.front() + share * points.back();
    if ((points[i] - onLine).norm() > tolerance) return false;
  }
  return true;
}

double extentOf(const std::vector<Vector2d>& points) {
  Vector2d low = points.front(), high = low;
  for (const Vector2d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).maxCoeff();
}

bool isOneTangent(const Vector2d& before, const Vector2d& at, const Vector2d& after) {
  constexpr double kAngle = 1e-3;  // rad
  const Vector2d in = (at - before).normalized(), out = (after - at).normalized();
  return std::abs(in.x() * out.y() - in.y() * out.x()) < kAngle && in.dot(out) > 0.0;
}

}  // namespace

ProfileSketch::ProfileSketch(const ProfileCurve& curve) {
  checkProfileCurve(curve, "profile");
  const int degree = curve.degree;
  degree_ = degree == 1 ? 3 : degree;
  const double size = extentOf(curve.points);
  const int last = static_cast<int>(curve.points.size()) - 1;
  closed_ = last >= 3 && (curve.points.back() - curve.points.front()).norm() <= 1e-9 * size;

  // Control points on the curve, with the knots there.
  std::vector<int> starts{0};
  for (int i = 1; i < last; ++i)
    if (curve.knots[i + 1] == curve.knots[i + degree]) starts.push_back(i);
  starts.push_back(last);
  for (std::size_t r = 0; r + 1 < starts.size(); ++r) {
    const int from = starts[r], to = starts[r + 1];
    const double low = curve.knots[from + degree], high = curve.knots[to + 1];
    Knots inner;
    for (int k = from + degree + 1; k <= to; ++k)
      inner.push_back((curve.knots[k] - low) / (high - low));
    std::vector<Vector2d> run(curve.points.begin() + from, curve.points.begin() + to + 1);
    points_.push_back({run.front(), SketchPointKind::kCorner});
    if (!(inner.empty() && isStraight(run, 1e-9 * size)))
      for (std::size_t i = 1; i + 1 < run.size(); ++i)
        points_.push_back({run[i], SketchPointKind::kControl});
    knots_.push_back(std::move(inner));
  }
  if (pointCount() < 3) closed_ = false;  // two lines, forth and back
  if (!closed_) points_.push_back({curve.points.back(), SketchPointKind::kCorner});
  for (int i = 0; i < pointCount(); ++i) {
    if (!isOnCurve(i) || (!closed_ && (i == 0 || i + 1 == pointCount()))) continue;
    const SketchPoint &before = points_[previous(i)], &after = points_[next(i)];
    if (before.kind == SketchPointKind::kControl && after.kind == SketchPointKind::kControl &&
        isOneTangent(before.at, points_[i].at, after.at))
      points_[i].kind = SketchPointKind::kSmooth;
  }
}

bool ProfileSketch::isOnCurve(int point) const {
  return points_.at(point).kind != SketchPointKind::kControl ||
         (!closed_ && (point == 0 || point + 1 == pointCount()));
}

int ProfileSketch::next(int point) const {
  return point + 1 == pointCount() ? 0 : point + 1;
}

int ProfileSketch::previous(int point) const {
  return point == 0 ? pointCount() - 1 : point - 1;
}

std::vector<int> ProfileSketch::runStarts() const {
  std::vector<int> starts;
  for (int i = 0; i < pointCount(); ++i)
    if (isOnCurve(i)) starts.push_back(i);
  return starts;
}

int ProfileSketch::runOf(int controlPoint) const {
  int run = -1;
  for (int i = 0; i <= controlPoint; ++i)
    if (isOnCurve(i)) ++run;
  return run;
}

ProfileSketch::Spline ProfileSketch::spline(int run) const {
  const std::vector<int> starts = runStarts();
  Spline result;
  int i = starts.at(run);
  do {
    result.points.push_back(points_[i].at);
    i = next(i);
  } while (!isOnCurve(i));
  result.points.push_back(points_[i].at);
  const int most = static_cast<int>(result.points.size()) - 1;
  result.basis = basisOver(std::min(degree_, most), knots_[run]);
  return result;
}

ProfileSketch::Spline ProfileSketch::elevated(int run) const {
  Spline result = spline(run);
  while (static_cast<int>(result.points.size()) <= degree_)
    result.points = elevatedOnce(result.points);
  result.basis = basisOver(degree_, knots_[run]);
  return result;
}

ProfileCurve ProfileSketch::curve() const {
  if (!isCurve()) throw std::logic_error("the sketch has too few points");
  ProfileCurve curve;
  const bool straight = std::none_of(points_.begin(), points_.end(), [&](const SketchPoint& p) {
    return !isOnCurve(static_cast<int>(&p - points_.data()));
  });
  curve.degree = straight ? 1 : degree_;
  const auto order = static_cast<std::size_t>(curve.degree) + 1;
  double begin = 0.0;
  curve.knots.assign(order, begin);
  for (int run = 0; run < runCount(); ++run) {
    const Spline piece = straight ? spline(run) : elevated(run);
    // Spans of length one for uniform knots.
    const int spans = piece.basis.spanCount();
    for (double knot : knots_[run]) curve.knots.push_back(begin + spans * knot);
    begin += spans;
    curve.knots.insert(curve.knots.end(), run + 1 < runCount() ? order - 1 : order, begin);
    curve.points.insert(curve.points.end(), piece.points.begin(), piece.points.end() - 1);
  }
  curve.points.push_back(closed_ ? curve.points.front() : points_.back().at);
  return curve;
}

Vector2d ProfileSketch::at(int run, double u) const {
  const Spline piece = spline(run);
  const Eigen::RowVectorXd values = basisValues(piece.basis, u);
  Vector2d sum = Vector2d::Zero();
  for (std::size_t i = 0; i < piece.points.size(); ++i)
    sum += values[static_cast<int>(i)] * piece.points[i];
  return sum;
}

std::vector<SketchPlace> ProfileSketch::samples() const {
  std::vector<SketchPlace> result;
  if (!isCurve()) return result;
  for (int run = 0; run < runCount(); ++run) {
    const Spline piece = spline(run);
    if (run == 0) result.push_back({0, 0.0, piece.points.front()});
    if (piece.points.size() == 2) {
      result.push_back({run, 1.0, piece.points.back()});
      continue;
    }
    std::vector<double> breaks{0.0};
    for (double knot : knots_[run])
      if (knot > breaks.back()) breaks.push_back(knot);
    breaks.push_back(1.0);
    const int perSpan = std::max(16, 128 / static_cast<int>(breaks.size() - 1));
    for (std::size_t span = 1; span < breaks.size(); ++span)
      for (int k = 1; k <= perSpan; ++k) {
        const double u = breaks[span - 1] + (breaks[span] - breaks[span - 1]) * k / perSpan;
        const Eigen::RowVectorXd values = basisValues(piece.basis, u);
        Vector2d sum = Vector2d::Zero();
        for (std::size_t i = 0; i < piece.points.size(); ++i)
          sum += values[static_cast<int>(i)] * piece.points[i];
        result.push_back({run, u, sum});
      }
  }
  return result;
}

std::array<Vector2d, 2> ProfileSketch::box() const {
  if (points_.empty()) return {Vector2d::Zero(), Vector2d::Zero()};
  std::array<Vector2d, 2> box{points_.front().at, points_.front().at};
  const std::vector<SketchPlace> places = samples();
  if (places.empty())
    for (const SketchPoint& point : points_) {
      box[0] = box[0].cwiseMin(point.at);
      box[1] = box[1].cwiseMax(point.at);
    }
  for (int side : {0, 1})
    for (int axis : {0, 1}) {
      const double sign = side == 0 ? -1.0 : 1.0;
      std::size_t most = 0;
      for (std::size_t i = 0; i < places.size(); ++i)
        if (sign * places[i].at[axis] > sign * places[most].at[axis]) most = i;
      if (!places.empty()) box[side][axis] = extreme(places, most, axis, sign);
    }
  return box;
}

double ProfileSketch::extreme(const std::vector<SketchPlace>& places, std::size_t most, int axis,
                              double sign) const {
  constexpr int kSteps = 60;  // each leaves two thirds of the interval
  double best = places[most].at[axis];
  const auto search = [&](int run, double low, double high) {
    for (int step = 0; step < kSteps; ++step) {
      const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
      const double atA = at(run, a)[axis], atB = at(run, b)[axis];
      (sign * atA > sign * atB ? high : low) = sign * atA > sign * atB ? b : a;
      for (double value : {atA, atB})
        if (sign * value > sign * best) best = value;
    }
  };
  const auto isCurved = [&](int run) { return spline(run).points.size() > 2; };
  const SketchPlace& middle = places[most];
  if (most > 0 && most + 1 < places.size() && places[most + 1].run == middle.run) {
    const SketchPlace& before = places[most - 1];
    if (isCurved(middle.run))
      search(middle.run, before.run == middle.run ? before.u : 0.0, places[most + 1].u);
  }
  return best;
}

}  // namespace palpa::modeling
