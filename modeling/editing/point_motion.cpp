#include "modeling/editing/point_motion.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/project/field_check.h"
#include "modeling/solid/surface_properties.h"
#include "modeling/solid/tangent_continuity.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

/// Search for the control point at a place.
class PointFinder {
 public:
  PointFinder(const std::vector<Vector3d>& points, double tolerance)
      : points_(points), tolerance_(tolerance) {
    for (std::size_t i = 0; i < points.size(); ++i)
      sorted_.push_back({kDirection.dot(points[i]), static_cast<int>(i)});
    std::sort(sorted_.begin(), sorted_.end());
  }

  /// The nearest point within the tolerance; -1 if there is none.
  int at(const Vector3d& place) const {
    const double key = kDirection.dot(place);
    auto next = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair(key - tolerance_, -1));
    int best = -1;
    double nearest = tolerance_;
    for (; next != sorted_.end() && next->first <= key + tolerance_; ++next) {
      const double distance = (points_[next->second] - place).norm();
      if (distance > nearest || (best >= 0 && distance == nearest)) continue;
      best = next->second;
      nearest = distance;
    }
    return best;
  }

 private:
  // A unit vector oblique to all axes, so that few points of a grid have the same key.
  inline static const Vector3d kDirection = Vector3d(0.5379, 0.2917, 0.7909).normalized();

  const std::vector<Vector3d>& points_;
  double tolerance_;
  std::vector<std::pair<double, int>> sorted_;
};

/// Displacements of all control points.
struct Displacements {
  std::vector<Vector3d> of;  // mm
  std::vector<char> moved;
  std::vector<char> given;  // prescribed by the command, not only following
};

/// Makes displacements symmetric. Each moved point must have a mirror image.
class Mirror {
 public:
  Mirror(const Solid& solid, const MirrorPlane& plane)
      : points_(solid.controlPoints()),
        point_(plane.point),
        tolerance_(toleranceOf(solid)),
        finder_(points_, tolerance_) {
    requireFinite(plane.point, "mirror.point_mm");
    requireDirection(plane.normal, "mirror.normal");
    normal_ = plane.normal.stableNormalized();
  }

  void apply(Displacements& displacements) const {
    const std::vector<Vector3d> original = displacements.of;
    const std::vector<char> moved = displacements.moved;
    const std::vector<char> given = displacements.given;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!moved[i]) continue;
      const double height = normal_.dot(points_[i] - point_);
      if (std::abs(height) <= tolerance_) {
        displacements.of[i] -= normal_.dot(original[i]) * normal_;
        continue;
      }
      const int other = finder_.at(points_[i] - 2.0 * height * normal_);
      if (other < 0)
        throw ModelingError("mirror: control point " + std::to_string(i) +
                            " has no mirror image; the solid is not symmetric about this plane");
      // In a moved pair the lower number computes, and the other gets the exact mirror image.
      if (moved[other] && other < static_cast<int>(i)) continue;
      if (moved[other]) displacements.of[i] = 0.5 * (original[i] + mirrored(original[other]));
      displacements.of[other] = mirrored(displacements.of[i]);
      displacements.moved[other] = 1;
      displacements.given[i] = displacements.given[other] = given[i] || given[other];
    }
  }

 private:
  static double toleranceOf(const Solid& solid) {
    const auto [low, high] = boundingBox(solid);
    return 1e-6 * (high - low).norm();
  }

  Vector3d mirrored(const Vector3d& v) const { return v - 2.0 * normal_.dot(v) * normal_; }

  const std::vector<Vector3d>& points_;
  Vector3d point_;
  Vector3d normal_;
  double tolerance_;
  PointFinder finder_;
};

/// Adds the motion of the points within the falloff of given ones.
void addFollowers(const std::vector<Vector3d>& points, double radius, const Motion& motion,
                  Displacements& displacements) {
  std::vector<int> leaders;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (displacements.given[i]) leaders.push_back(static_cast<int>(i));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (displacements.moved[i]) continue;
    int leader = -1;
    double nearest = radius * radius;
    for (int candidate : leaders) {
      const double distance = (points[candidate] - points[i]).squaredNorm();
      if (distance >= nearest) continue;
      nearest = distance;
      leader = candidate;
    }
    if (leader < 0) continue;
    const double part = 1.0 - nearest / (radius * radius);
    displacements.of[i] = part * part * motion(static_cast<int>(i), leader);
    displacements.moved[i] = 1;
  }
}

}  // namespace

Solid movePoints(const Solid& solid, const std::vector<int>& selected, const Reach& reach,
                 const Motion& motion) {
  const std::vector<Vector3d>& points = solid.controlPoints();
  Displacements displacements{std::vector<Vector3d>(points.size(), Vector3d::Zero()),
                              std::vector<char>(points.size(), 0),
                              std::vector<char>(points.size(), 0)};
  for (int index : selected) {
    displacements.of[index] = motion(index, index);
    displacements.moved[index] = displacements.given[index] = 1;
  }
  if (reach.falloff) requirePositive(*reach.falloff, "falloff_mm");
  if (reach.mirror) {
    const Mirror mirror(solid, *reach.mirror);
    mirror.apply(displacements);
    if (reach.falloff) {
      // `motion` accepts selected leaders only: mirror images have their symmetric displacements.
      const std::vector<Vector3d> symmetric = displacements.of;
      std::vector<char> isSelected(points.size(), 0);
      for (int index : selected) isSelected[index] = 1;
      addFollowers(
          points, *reach.falloff,
          [&](int point, int leader) {
            return isSelected[leader] ? motion(point, leader) : symmetric[leader];
          },
          displacements);
      mirror.apply(displacements);
    }
  } else if (reach.falloff) {
    addFollowers(points, *reach.falloff, motion, displacements);
  }
  std::vector<Vector3d> result = points;
  std::vector<int> given;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (displacements.moved[i]) result[i] += displacements.of[i];
    if (displacements.given[i]) given.push_back(static_cast<int>(i));
  }
  return restoreTangents(solid, solid.withControlPoints(std::move(result)), given);
}

}  // namespace palpa::modeling
