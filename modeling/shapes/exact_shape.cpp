#include "modeling/shapes/exact_shape.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>

#include "modeling/solid/surface_evaluator.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

/// List of control points in which coincident points on patch borders share one index.
class PointList {
 public:
  explicit PointList(double tolerance) : tolerance_(tolerance) {}

  int add(Vector3d p, bool onBorder) {
    // Rounding leaves ±1e-15 where zero is meant; clean files and exact planes need the zero.
    for (double& value : p)
      if (std::abs(value) < tolerance_) value = 0.0;
    if (!onBorder) return append(p);
    const double key = kDirection.dot(p);
    for (auto near = borderPoints_.lower_bound(key - tolerance_);
         near != borderPoints_.end() && near->first <= key + tolerance_; ++near)
      if ((points_[near->second] - p).norm() <= tolerance_) return near->second;
    const int index = append(p);
    borderPoints_.emplace(key, index);
    return index;
  }

  std::vector<Vector3d> take() { return std::move(points_); }

 private:
  int append(const Vector3d& p) {
    points_.push_back(p);
    return static_cast<int>(points_.size()) - 1;
  }

  // Unit vector along which few points of a symmetric shape have the same coordinate.
  inline static const Vector3d kDirection = Vector3d(0.8091, 0.5117, 0.2891).normalized();

  double tolerance_;
  std::vector<Vector3d> points_;
  std::multimap<double, int> borderPoints_;  // coordinate along kDirection -> index
};

double distanceFrom(const ExactPatch& patch, double s, double t, const Vector3d& point) {
  constexpr int kSteps = 3;
  constexpr double kDifference = 1e-5;
  Vector3d offset = point - patch.surface(s, t);
  for (int step = 0; step < kSteps; ++step) {
    const double s0 = std::max(0.0, s - kDifference), s1 = std::min(1.0, s + kDifference);
    const double t0 = std::max(0.0, t - kDifference), t1 = std::min(1.0, t + kDifference);
    Eigen::Matrix<double, 3, 2> tangents;
    tangents.col(0) = (patch.surface(s1, t) - patch.surface(s0, t)) / (s1 - s0);
    tangents.col(1) = (patch.surface(s, t1) - patch.surface(s, t0)) / (t1 - t0);
    // Rank-revealing, because the tangents are parallel in the corners of a round cap.
    const Eigen::Vector2d move = tangents.completeOrthogonalDecomposition().solve(offset);
    const double nextS = std::clamp(s + move.x(), 0.0, 1.0);
    const double nextT = std::clamp(t + move.y(), 0.0, 1.0);
    const Vector3d next = point - patch.surface(nextS, nextT);
    if (!(next.norm() < offset.norm())) break;
    s = nextS;
    t = nextT;
    offset = next;
  }
  return offset.norm();
}

/// Parameters on a grid that includes the ends and middles of all spans.
std::vector<double> samples(const std::vector<double>& spans) {
  const int count = static_cast<int>(spans.size()) - 1;
  const int perSpan = count <= 8 ? 8 : count <= 16 ? 4 : 2;
  std::vector<double> result;
  for (int k = 0; k < count; ++k)
    for (int i = 0; i < perSpan; ++i)
      result.push_back(spans[k] + (spans[k + 1] - spans[k]) * i / perSpan);
  result.push_back(spans.back());
  return result;
}

}  // namespace

Solid toSolid(const ExactShape& shape) {
  PointList points(1e-9 * shape.smallestLength);
  std::vector<Patch> patches;
  std::vector<PatchEdge> smoothEdges;
  for (const ExactPatch& exact : shape.patches) {
    const auto& [u, v] = exact.basis;
    const PointGrid grid = interpolate(u, v, exact.surface);
    Patch patch{exact.name, {u.degree, v.degree}, {u.knots, v.knots}, {}};
    patch.net.assign(u.count(), std::vector<int>(v.count()));
    for (int i = 0; i < u.count(); ++i)
      for (int j = 0; j < v.count(); ++j) {
        const bool onBorder = i == 0 || j == 0 || i + 1 == u.count() || j + 1 == v.count();
        patch.net[i][j] = points.add(grid[i][j], onBorder);
      }
    for (Side side : kSides)
      if (exact.smooth[static_cast<int>(side)] && patch.degree[1 - directionOf(side)] > 1)
        smoothEdges.push_back({static_cast<int>(patches.size()), side});
    patches.push_back(std::move(patch));
  }
  return Solid(points.take(), std::move(patches), smoothEdges);
}

double largestDeviation(const ExactShape& shape, const Solid& solid) {
  const SurfaceEvaluator made(solid);
  double largest = 0.0;
  for (std::size_t p = 0; p < shape.patches.size(); ++p) {
    const int patch = static_cast<int>(p);
    const std::vector<double> vSamples = samples(made.spans(patch, 1));
    for (double u : samples(made.spans(patch, 0)))
      for (double v : vSamples)
        largest =
            std::max(largest, distanceFrom(shape.patches[p], u, v, made.position(patch, u, v)));
  }
  return largest;
}

}  // namespace palpa::modeling
