#include "app/view/camera_fit.h"

#include <vtkCamera.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace palpa::view {
namespace {

constexpr double kVerticalViewAngle = 24 * std::numbers::pi / 180;

/// Bounds of all points as seen along the view: horizontally, vertically, in depth.
struct ViewBounds {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity());

  void add(const Eigen::Vector3d& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  Eigen::Vector3d center() const { return 0.5 * (low + high); }
  Eigen::Vector3d size() const { return high - low; }
};

ViewBounds boundsOf(const std::vector<Eigen::Vector3d>& points, const Eigen::Matrix3d& toView) {
  ViewBounds bounds;
  for (const Eigen::Vector3d& point : points) bounds.add(toView * point);
  return bounds;
}

/// Where the camera looks and how large things appear there.
struct Placement {
  Eigen::Vector3d focus;       ///< in view coordinates
  double pixelsPerLength = 1;  ///< in the plane through the focus
};

/// The perspective picture of all points, in lengths of the plane through the focus, seen from
/// `distance` in front of it.
ViewBounds perspectiveBounds(const std::vector<Eigen::Vector3d>& points,
                             const Eigen::Matrix3d& toView, const Eigen::Vector3d& focus,
                             double distance) {
  ViewBounds bounds;
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

Placement place(bool parallel, const std::vector<Eigen::Vector3d>& points,
                const Eigen::Matrix3d& toView, const Rectangle& target, int height) {
  const ViewBounds flat = boundsOf(points, toView);
  Placement placement{flat.center(), fittingScale(flat.size(), target)};
  if (parallel) return placement;
  // The perspective size depends on the distance, and that on the size: a contraction, since near
  // parts grow only by (size / distance). Eight rounds are far below a pixel.
  for (int round = 0; round < 8; ++round) {
    const double distance =
        height / (2 * placement.pixelsPerLength * std::tan(kVerticalViewAngle / 2));
    const ViewBounds seen = perspectiveBounds(points, toView, placement.focus, distance);
    placement.focus.head<2>() += seen.center().head<2>();
    placement.pixelsPerLength = fittingScale(seen.size(), target);
  }
  return placement;
}

/// Clips nothing of the points, nor of arrow heads around them.
void resetClippingRange(const std::vector<Eigen::Vector3d>& points, vtkRenderer* renderer) {
  const ViewBounds bounds = boundsOf(points, Eigen::Matrix3d::Identity());
  const double margin = 0.05 * bounds.size().norm();
  const Eigen::Vector3d low = bounds.low.array() - margin;
  const Eigen::Vector3d high = bounds.high.array() + margin;
  const double box[6] = {low.x(), high.x(), low.y(), high.y(), low.z(), high.z()};
  renderer->ResetCameraClippingRange(box);
}

}  // namespace

ViewAxes viewAxes(const CameraView& view) {
  ViewAxes axes;
  axes.forward = view.direction.normalized();
  axes.right = axes.forward.cross(view.up).normalized();
  axes.up = axes.right.cross(axes.forward);
  return axes;
}

void fitCamera(const CameraView& view, const std::vector<Eigen::Vector3d>& points,
               const Rectangle& target, int width, int height, vtkRenderer* renderer) {
  const ViewAxes axes = viewAxes(view);
  Eigen::Matrix3d toView;
  toView << axes.right.transpose(), axes.up.transpose(), axes.forward.transpose();

  const Placement placement = place(view.parallel, points, toView, target, height);
  const double scale = placement.pixelsPerLength * view.zoom;
  const double visibleHeight = height / scale;
  const double distance = view.parallel ? 2 * boundsOf(points, toView).size().norm()
                                        : visibleHeight / (2 * std::tan(kVerticalViewAngle / 2));
  const Eigen::Vector3d focus = toView.transpose() * placement.focus;
  const Eigen::Vector3d eye = focus - distance * axes.forward;

  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetFocalPoint(focus.data());
  camera->SetPosition(eye.data());
  camera->SetViewUp(axes.up.data());
  camera->SetParallelProjection(view.parallel);
  camera->SetParallelScale(visibleHeight / 2);
  camera->SetViewAngle(kVerticalViewAngle * 180 / std::numbers::pi);
  // Moves the optical axis to the middle of the target without turning the camera.
  camera->SetWindowCenter(1 - (target.left + target.right) / width,
                          1 - (target.bottom + target.top) / height);
  resetClippingRange(points, renderer);
}

Eigen::Vector2d toPixels(const Eigen::Vector3d& point, vtkRenderer* renderer) {
  renderer->SetWorldPoint(point.x(), point.y(), point.z(), 1);
  renderer->WorldToDisplay();
  const double* display = renderer->GetDisplayPoint();
  return {display[0], display[1]};
}

}  // namespace palpa::view
