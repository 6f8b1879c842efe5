#include "modeling/exchange/polygon_triangulation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace palpa::modeling {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Twice the signed area over the sum of squared sides: 0 for degenerate, negative for inverted,
/// largest for equilateral triangles.
double shape(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const double sides = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return sides > 0.0 ? cross(b - a, c - a) / sides : 0.0;
}

class EarClipping {
 public:
  EarClipping(std::vector<Vector2d> at, std::span<const int> polygon)
      : at_(std::move(at)), polygon_(polygon) {
    const int n = static_cast<int>(polygon.size());
    for (int i = 0; i < n; ++i) {
      before_.push_back((i + n - 1) % n);
      after_.push_back((i + 1) % n);
    }
    for (int i = 0; i < n; ++i) quality_.push_back(quality(i));
  }

  std::vector<std::array<int, 3>> run() {
    std::vector<std::array<int, 3>> triangles;
    int first = 0;
    int refreshes = 20;
    for (std::size_t left = polygon_.size(); left > 3; --left) {
      int ear = bestEar(first);
      if (quality_[ear] <= 0.0 && refreshes-- > 0) {
        // Earlier obstacles may be removed by now. A self-crossing polygon may have no ears.
        for (int i = after_[ear]; i != ear; i = after_[i]) quality_[i] = quality(i);
        quality_[ear] = quality(ear);
        ear = bestEar(first);
      }
      const int a = before_[ear];
      const int b = after_[ear];
      triangles.push_back({polygon_[a], polygon_[ear], polygon_[b]});
      after_[a] = b;
      before_[b] = a;
      quality_[a] = quality(a);
      quality_[b] = quality(b);
      first = a;
    }
    triangles.push_back({polygon_[before_[first]], polygon_[first], polygon_[after_[first]]});
    return triangles;
  }

 private:
  int bestEar(int first) const {
    int best = first;
    for (int i = after_[first]; i != first; i = after_[i])
      if (quality_[i] > quality_[best]) best = i;
    return best;
  }

  /// Shape of the ear at corner i; not positive if the corner is not an ear.
  double quality(int i) const {
    const Vector2d& a = at_[before_[i]];
    const Vector2d& b = at_[i];
    const Vector2d& c = at_[after_[i]];
    const double own = shape(a, b, c);
    if (own <= 0.0) return own;
    for (int j = after_[after_[i]]; j != before_[i]; j = after_[j]) {
      const Vector2d& p = at_[j];
      if (p != a && p != b && p != c && cross(b - a, p - a) >= 0.0 && cross(c - b, p - b) >= 0.0 &&
          cross(a - c, p - c) >= 0.0)
        return -1.0;
    }
    return own;
  }

  std::vector<Vector2d> at_;
  std::span<const int> polygon_;
  std::vector<int> before_;
  std::vector<int> after_;
  std::vector<double> quality_;
};

}  // namespace

std::vector<std::array<int, 3>> triangulatePolygon(const std::vector<Vector3d>& points,
                                                   std::span<const int> polygon) {
  if (polygon.size() == 3) return {{polygon[0], polygon[1], polygon[2]}};
  const Vector3d origin = points[polygon[0]];
  Vector3d normal = Vector3d::Zero();  // Newell's method
  for (std::size_t i = 0; i < polygon.size(); ++i)
    normal +=
        (points[polygon[i]] - origin).cross(points[polygon[(i + 1) % polygon.size()]] - origin);
  if (normal.norm() == 0.0) normal = Vector3d::UnitZ();
  const Vector3d u = normal.unitOrthogonal();
  const Vector3d v = normal.normalized().cross(u);
  std::vector<Vector2d> at;
  for (int corner : polygon)
    at.emplace_back(u.dot(points[corner] - origin), v.dot(points[corner] - origin));
  return EarClipping(std::move(at), polygon).run();
}

}  // namespace palpa::modeling
