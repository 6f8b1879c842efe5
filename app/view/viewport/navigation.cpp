#include "app/view/viewport/checks.h"
#include "app/view/viewport/parts.h"

// The camera of a viewport: orbit, pan, zoom, standard views, and fitting to points.
namespace palpa::view {
namespace {

constexpr double kRadiansPerPixel = 0.007;  // logical pixels: half a turn in 450

CameraView directions(StandardView view) {
  CameraView camera;
  switch (view) {
    case StandardView::kFront:
      camera.direction = {0, 1, 0};
      break;
    case StandardView::kBack:
      camera.direction = {0, -1, 0};
      break;
    case StandardView::kLeft:
      camera.direction = {1, 0, 0};
      break;
    case StandardView::kRight:
      camera.direction = {-1, 0, 0};
      break;
    case StandardView::kTop:
      camera.direction = {0, 0, -1};
      camera.up = {0, 1, 0};
      break;
    case StandardView::kBottom:
      camera.direction = {0, 0, 1};
      camera.up = {0, -1, 0};
      break;
    case StandardView::kIsometric:
      camera.direction = {-1, 1, -1};
      break;
  }
  return camera;
}

}  // namespace

void Viewport::orbit(const Eigen::Vector2d& pixels) {
  const Eigen::Vector2d angles = -kRadiansPerPixel / parts_->inputRatio() * pixels;
  parts_->camera.orbit(angles.x(), angles.y());
}

void Viewport::pan(const Eigen::Vector2d& pixels, const std::optional<Eigen::Vector2d>& from) {
  parts_->syncSize();
  parts_->camera.pan(pixels, from ? parts_->pointUnder(*from) : parts_->camera.focus());
}

void Viewport::zoom(double factor, const Eigen::Vector2d& at) {
  require(factor > 0, "a zoom factor is positive");
  parts_->syncSize();
  parts_->camera.zoom(factor, parts_->pointUnder(at));
}

void Viewport::fit() {
  fitTo(parts_->shownPoints());
}

void Viewport::fitTo(const std::vector<Eigen::Vector3d>& points) {
  parts_->syncSize();
  parts_->camera.fit(points, parts_->fitMargin(), parts_->fitReserve(false));
}

void Viewport::lookFrom(StandardView view) {
  const CameraView camera = directions(view);
  parts_->camera.setDirection(camera.direction, camera.up);
}

void Viewport::lookAtCubePart(const ViewCubePart& part) {
  turnTo(part, parts_->camera);
}

void Viewport::setParallelProjection(bool parallel) {
  parts_->camera.setParallel(parallel);
}

bool Viewport::parallelProjection() const {
  return parts_->camera.parallel();
}

CameraView Viewport::camera() const {
  parts_->syncSize();
  const Turntable& camera = parts_->camera;
  const ViewAxes axes = camera.axes();
  const double fitting = camera.fittingDistance(parts_->shownPoints(), parts_->fitMargin());
  return {axes.forward, axes.up, camera.parallel(), fitting / camera.distance()};
}

void Viewport::setCamera(const CameraView& view) {
  // Without reserve: a CameraView means the same with and without a field.
  parts_->look(view, parts_->shownPoints(), {});
}

void Viewport::frame(const CameraView& view, const std::vector<Eigen::Vector3d>& room) {
  parts_->syncSize();
  std::vector<Eigen::Vector3d> points = parts_->shownPoints();
  for (const ForceArrows* arrows : {&parts_->liveArrows, &parts_->gradientArrows})
    points.insert(points.end(), arrows->ends().begin(), arrows->ends().end());
  points.insert(points.end(), room.begin(), room.end());
  for (const Ball& ball : parts_->balls.balls())
    for (const double side : {-ball.radius, ball.radius})
      for (int k = 0; k < 3; ++k) points.push_back(ball.center + side * Eigen::Vector3d::Unit(k));
  parts_->look(view, points, parts_->fitReserve(true));
}

}  // namespace palpa::view
