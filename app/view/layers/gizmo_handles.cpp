#include "app/view/layers/gizmo_handles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace palpa::view {
namespace {

/// Distance from `point` to the segment between `a` and `b`.
double distanceToSegment(const Eigen::Vector2d& point, const Eigen::Vector2d& a,
                         const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double lengthSquared = along.squaredNorm();
  const double t =
      lengthSquared > 0 ? std::clamp(along.dot(point - a) / lengthSquared, 0.0, 1.0) : 0.0;
  return (point - a - t * along).norm();
}

// In logical pixels.
constexpr double kReach = 8;
constexpr double kMinSeenLength = 26;
constexpr double kFree = 6;  // between a handle and the edge of the picture
/// Handles whose distances to the pointer differ by less lie on top of each other.
constexpr double kSamePlace = 2;
/// A ring shows its points up to this sine behind the plane of the screen through the gizmo, so
/// that one parallel to the screen is whole and does not flicker.
constexpr double kBehind = 0.12;
constexpr int kRingPieces = 96;

struct Axis {
  GizmoAxis name;
  Eigen::Vector3d direction;
};

std::vector<Axis> axesOf(const Gizmo& gizmo) {
  std::vector<Axis> axes{{GizmoAxis::kX, Eigen::Vector3d::UnitX()},
                         {GizmoAxis::kY, Eigen::Vector3d::UnitY()},
                         {GizmoAxis::kZ, Eigen::Vector3d::UnitZ()}};
  if (gizmo.normal && gizmo.normal->norm() > 0) {
    axes.push_back({GizmoAxis::kNormal, gizmo.normal->normalized()});
  }
  if (gizmo.gradient && gizmo.gradient->norm() > 0) {
    axes.push_back({GizmoAxis::kGradient, gizmo.gradient->normalized()});
  }
  return axes;
}

GizmoRing makeRing(GizmoAxis axis, const Eigen::Vector3d& at, const Eigen::Vector3d& normal,
                   double radius, const Eigen::Vector3d& sight) {
  const Eigen::Vector3d across = normal.unitOrthogonal();
  const Eigen::Vector3d along = normal.cross(across);
  const auto towards = [&](int i) {
    const double angle = 2 * std::numbers::pi * i / kRingPieces;
    return Eigen::Vector3d(std::cos(angle) * across + std::sin(angle) * along);
  };
  GizmoRing ring{axis, {}};
  for (int i = 0; i < kRingPieces; ++i) {
    const Eigen::Vector3d a = towards(i);
    const Eigen::Vector3d b = towards(i + 1);
    if ((a + b).dot(sight) > 2 * kBehind) continue;
    ring.segments.push_back({at + radius * a, at + radius * b});
  }
  return ring;
}

}  // namespace

std::optional<double> gizmoScale(const Gizmo& gizmo, const Turntable& camera, double pixelRatio) {
  if (!camera.toPixel(gizmo.at).allFinite()) return std::nullopt;
  return pixelRatio / camera.pixelsPerLength(camera.depth(gizmo.at));
}

Gizmo gizmoInPicture(const Gizmo& gizmo, const Turntable& camera, double pixelRatio) {
  const Eigen::Vector2d picture(camera.width(), camera.height());
  const Eigen::Vector2d pixel = camera.toPixel(gizmo.at);
  const bool isSeen = (pixel.array() >= 0).all() && (pixel.array() <= picture.array()).all();
  if (!isSeen) return gizmo;  // also behind the eye: NaN
  // In a small picture the middle is the best place.
  const Eigen::Vector2d room =
      Eigen::Vector2d::Constant((gizmo_size::kEnd + kFree) * pixelRatio).cwiseMin(0.5 * picture);
  const Eigen::Vector2d place = pixel.cwiseMax(room).cwiseMin(picture - room);
  if (place == pixel) return gizmo;
  Gizmo moved = gizmo;
  moved.at = camera.inViewPlane(place, gizmo.at);
  return moved;
}

std::vector<GizmoArrow> gizmoArrows(const Gizmo& gizmo, const Turntable& camera,
                                    double pixelRatio) {
  std::vector<GizmoArrow> arrows;
  const auto scale = gizmoScale(gizmo, camera, pixelRatio);
  if (!scale || gizmo.kind == GizmoKind::kRotate) return arrows;
  for (const auto& [axis, direction] : axesOf(gizmo)) {
    const GizmoArrow arrow{axis, direction, gizmo.at + *scale * gizmo_size::kStart * direction,
                           gizmo.at + *scale * gizmo_size::kEnd * direction};
    const double seen = (camera.toPixel(arrow.end) - camera.toPixel(gizmo.at)).norm();
    // Also false for an arrow that ends behind the eye.
    if (seen >= kMinSeenLength * pixelRatio) arrows.push_back(arrow);
  }
  return arrows;
}

std::vector<GizmoRing> gizmoRings(const Gizmo& gizmo, const Turntable& camera, double pixelRatio) {
  std::vector<GizmoRing> rings;
  const auto scale = gizmoScale(gizmo, camera, pixelRatio);
  if (!scale || gizmo.kind != GizmoKind::kRotate) return rings;
  // The line of sight to the gizmo, not the direction of view: also right far from the middle.
  const Eigen::Vector3d sight = camera.parallel()
                                    ? camera.axes().forward
                                    : Eigen::Vector3d((gizmo.at - camera.eye()).normalized());
  rings.push_back(
      makeRing(GizmoAxis::kAll, gizmo.at, sight, *scale * gizmo_size::kOuterRing, sight));
  for (const auto& [axis, direction] : axesOf(gizmo)) {
    rings.push_back(makeRing(axis, gizmo.at, direction, *scale * gizmo_size::kRing, sight));
  }
  return rings;
}

GizmoAxis gizmoAxisAt(const Eigen::Vector2d& pixel, const Gizmo& gizmo, const Turntable& camera,
                      double pixelRatio) {
  struct Candidate {
    GizmoAxis axis;
    double distance;
    double depth;
  };
  std::vector<Candidate> candidates;
  const double reach = kReach * pixelRatio;
  const auto add = [&](GizmoAxis axis, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const double distance = distanceToSegment(pixel, camera.toPixel(a), camera.toPixel(b));
    if (distance <= reach) {
      candidates.push_back({axis, distance, 0.5 * (camera.depth(a) + camera.depth(b))});
    }
  };
  // The handle in the middle lies on the arrows that start there.
  const bool hasMiddle = gizmo.kind != GizmoKind::kRotate;
  if (hasMiddle && (camera.toPixel(gizmo.at) - pixel).norm() <= reach) return GizmoAxis::kAll;
  for (const GizmoArrow& arrow : gizmoArrows(gizmo, camera, pixelRatio)) {
    add(arrow.axis, arrow.start, arrow.end);
  }
  for (const GizmoRing& ring : gizmoRings(gizmo, camera, pixelRatio)) {
    for (const auto& [a, b] : ring.segments) add(ring.axis, a, b);
  }
  double smallest = std::numeric_limits<double>::infinity();
  for (const Candidate& candidate : candidates) smallest = std::min(smallest, candidate.distance);
  std::erase_if(candidates, [&](const Candidate& candidate) {
    return candidate.distance > smallest + kSamePlace * pixelRatio;
  });
  // Arrows cross only in the middle: there the nearest counts, not the one in front.
  const bool byDepth = gizmo.kind == GizmoKind::kRotate;
  const auto first = std::min_element(
      candidates.begin(), candidates.end(), [&](const Candidate& a, const Candidate& b) {
        return byDepth ? a.depth < b.depth : a.distance < b.distance;
      });
  return first == candidates.end() ? GizmoAxis::kNone : first->axis;
}

}  // namespace palpa::view
