#include "app/view/camera_fit.h"

#include <vtkCamera.h>

#include <cmath>
#include <numbers>

#include "app/view/bounds.h"

namespace palpa::view {
namespace {

/// Clips nothing of the points, nor of arrow heads around them.
void resetClippingRange(const std::vector<Eigen::Vector3d>& points, vtkRenderer* renderer) {
  Bounds bounds;
  for (const Eigen::Vector3d& point : points) bounds.add(point);
  const double margin = 0.05 * bounds.size().norm();
  const Eigen::Vector3d low = bounds.low.array() - margin;
  const Eigen::Vector3d high = bounds.high.array() + margin;
  const double box[6] = {low.x(), high.x(), low.y(), high.y(), low.z(), high.z()};
  renderer->ResetCameraClippingRange(box);
}

}  // namespace

void fitCamera(const CameraView& view, const std::vector<Eigen::Vector3d>& points,
               const Rectangle& target, int width, int height, vtkRenderer* renderer) {
  const ViewAxes axes = viewAxes(view);
  const Eigen::Matrix3d toView = axes.toView();

  const Placement placement = fitPlacement(view.parallel, points, toView, target, height);
  const double scale = placement.pixelsPerLength * view.zoom;
  const double visibleHeight = height / scale;
  Bounds bounds;
  for (const Eigen::Vector3d& point : points) bounds.add(toView * point);
  const double distance = view.parallel ? 2 * bounds.size().norm()
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
