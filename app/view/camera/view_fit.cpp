#include "app/view/camera/view_fit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/view/camera/bounds.h"

namespace palpa::view {
namespace {

/// The perspective picture of all points, in lengths of the plane through the focus, seen from
/// `distance` in front of it.
Bounds perspectiveBounds(const std::vector<Eigen::Vector3d>& points, const Eigen::Matrix3d& toView,
                         const Eigen::Vector3d& focus, double distance) {
  Bounds bounds;
  for (const Eigen::Vector3d& point : points) {
    Eigen::Vector3d seen = toView * point - focus;
    seen.head<2>() *= distance / std::max(distance + seen.z(), 1e-3 * distance);
    bounds.add(seen);
  }
  return bounds;
}

double fittingScale(const Eigen::Vector3d& size, const Rectangle& target) {
  const double tiny = 1e-12 * std::max(size.norm(), std::numeric_limits<double>::min());
  return std::min(target.width() / std::max(size.x(), tiny),
                  target.height() / std::max(size.y(), tiny));
}

}  // namespace

Eigen::Matrix3d ViewAxes::toView() const {
  Eigen::Matrix3d matrix;
  matrix << right.transpose(), up.transpose(), forward.transpose();
  return matrix;
}

ViewAxes viewAxes(const CameraView& view) {
  ViewAxes axes;
  axes.forward = view.direction.normalized();
  axes.right = axes.forward.cross(view.up).normalized();
  axes.up = axes.right.cross(axes.forward);
  return axes;
}

Placement fitPlacement(bool parallel, const std::vector<Eigen::Vector3d>& points,
                       const Eigen::Matrix3d& toView, const Rectangle& target, int height) {
  Bounds flat;
  for (const Eigen::Vector3d& point : points) flat.add(toView * point);
  Placement placement{flat.center(), fittingScale(flat.size(), target)};
  if (parallel) return placement;
  // The eye keeps away from what is long and seen end on.
  const double nearest = std::max(flat.size().z(), std::numeric_limits<double>::min());
  const double largest = height / (2 * nearest * std::tan(kVerticalViewAngle / 2));
  placement.pixelsPerLength = std::min(placement.pixelsPerLength, largest);
  // The perspective size depends on the distance, and the distance on the size: a contraction,
  // since near parts grow only by (size / distance). After eight rounds the error is far below a
  // pixel.
  for (int round = 0; round < 8; ++round) {
    const double distance =
        height / (2 * placement.pixelsPerLength * std::tan(kVerticalViewAngle / 2));
    const Bounds seen = perspectiveBounds(points, toView, placement.focus, distance);
    placement.focus.head<2>() += seen.center().head<2>();
    placement.pixelsPerLength = std::min(fittingScale(seen.size(), target), largest);
  }
  return placement;
}

}  // namespace palpa::view
