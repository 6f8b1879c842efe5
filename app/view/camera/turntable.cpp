#include "app/view/camera/turntable.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace palpa::view {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2;
constexpr double kEmptySceneRadius = 50;   // mm
constexpr double kNearestDistance = 2e-3;  // in radii of the scene
constexpr double kFarthestDistance = 200;

double halfAngleTangent() {
  return std::tan(kVerticalViewAngle / 2);
}

}  // namespace

Turntable::Turntable() {
  const CameraView usual;
  setDirection(usual.direction, usual.up);
}

void Turntable::setSize(int width, int height) {
  width_ = std::max(width, 1);
  height_ = std::max(height, 1);
}

void Turntable::setScene(const Bounds& bounds) {
  sceneCenter_ = bounds.empty() ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : bounds.center();
  const double radius = bounds.empty() ? 0 : 0.5 * bounds.size().norm();
  sceneRadius_ = radius > 0 ? radius : kEmptySceneRadius;
}

void Turntable::setDirection(const Eigen::Vector3d& direction, const Eigen::Vector3d& up) {
  const Eigen::Vector3d forward = direction.normalized();
  elevation_ = std::asin(std::clamp(forward.z(), -1.0, 1.0));
  // Straight up or down, the top of the picture tells which way is ahead.
  const bool vertical = forward.head<2>().norm() < 1e-9;
  Eigen::Vector2d ahead = forward.head<2>();
  if (vertical) ahead = (forward.z() < 0 ? 1 : -1) * up.head<2>();
  azimuth_ = std::atan2(ahead.y(), ahead.x());
}

void Turntable::orbit(double azimuth, double elevation) {
  azimuth_ = std::remainder(azimuth_ + azimuth, 2 * std::numbers::pi);
  elevation_ = std::clamp(elevation_ + elevation, -kRightAngle, kRightAngle);
}

void Turntable::turn(double azimuth, double elevation) {
  double tilt = elevation_ + elevation;
  double aside = azimuth;
  if (std::abs(tilt) > kRightAngle + 1e-9) {
    tilt = std::copysign(2 * kRightAngle, tilt) - tilt;
    aside += 2 * kRightAngle;
  }
  orbit(aside, tilt - elevation_);
}

void Turntable::pan(const Eigen::Vector2d& pixels, const Eigen::Vector3d& point) {
  const ViewAxes view = axes();
  const double at = depth(point);
  const double scale = pixelsPerLength(at > 0 ? at : distance_);
  focus_ -= (pixels.x() * view.right - pixels.y() * view.up) / scale;
}

void Turntable::zoom(double factor, const Eigen::Vector3d& point) {
  const double before = distance_;
  setDistance(distance_ / factor);
  // Everything shrinks towards the point, the eye included: the point's line of sight stays.
  focus_ = point + (focus_ - point) * (distance_ / before);
}

void Turntable::setDistance(double distance) {
  distance_ =
      std::clamp(distance, kNearestDistance * sceneRadius_, kFarthestDistance * sceneRadius_);
}

Turntable::Fit Turntable::fitting(const std::vector<Eigen::Vector3d>& points, double margin,
                                  const Reserve& reserve) const {
  Bounds bounds;
  for (const Eigen::Vector3d& point : points) bounds.add(point);
  const double size = bounds.empty() ? 0 : bounds.size().norm();
  if (size <= 1e-9 * sceneRadius_) return {bounds.empty() ? focus_ : bounds.center(), distance_};

  const double spare = std::min({margin, 0.25 * width_, 0.25 * height_});
  const double right = std::min(reserve.right, width_ / 3.0);
  const double top = std::min(reserve.top, height_ / 4.0);
  const double bottom = std::min(reserve.bottom, height_ / 4.0);
  const Rectangle target{spare, spare + bottom, width_ - spare - right, height_ - spare - top};
  const Eigen::Matrix3d toView = axes().toView();
  const Placement placement = fitPlacement(parallel_, points, toView, target, height_);
  const double distance = height_ / (2 * placement.pixelsPerLength * halfAngleTangent());
  // A line seen end on would draw the camera into it.
  if (!(distance >= size)) return {bounds.center(), size};
  // The focus appears in the middle of the picture, beside the middle of the target.
  const Eigen::Vector3d aside =
      Eigen::Vector3d(0.5 * right, 0.5 * (top - bottom), 0) / placement.pixelsPerLength;
  return {toView.transpose() * (placement.focus + aside), distance};
}

void Turntable::fit(const std::vector<Eigen::Vector3d>& points, double margin,
                    const Reserve& reserve) {
  const Fit found = fitting(points, margin, reserve);
  focus_ = found.focus;
  setDistance(found.distance);
}

double Turntable::fittingDistance(const std::vector<Eigen::Vector3d>& points, double margin) const {
  return fitting(points, margin, {}).distance;
}

ViewAxes Turntable::axes() const {
  ViewAxes view;
  view.forward = {std::cos(elevation_) * std::cos(azimuth_),
                  std::cos(elevation_) * std::sin(azimuth_), std::sin(elevation_)};
  view.right = {std::sin(azimuth_), -std::cos(azimuth_), 0};
  view.up = view.right.cross(view.forward);
  return view;
}

Eigen::Vector3d Turntable::eye() const {
  const double back =
      parallel_ ? distance_ + (focus_ - sceneCenter_).norm() + 4 * sceneRadius_ : distance_;
  return focus_ - back * axes().forward;
}

double Turntable::visibleHeight() const {
  return 2 * distance_ * halfAngleTangent();
}

double Turntable::depth(const Eigen::Vector3d& point) const {
  return (point - eye()).dot(axes().forward);
}

double Turntable::pixelsPerLength(double depth) const {
  return height_ / (2 * (parallel_ ? distance_ : depth) * halfAngleTangent());
}

Eigen::Vector2d Turntable::toPixel(const Eigen::Vector3d& point) const {
  const double inFront = depth(point);
  if (!parallel_ && !(inFront > 1e-9 * distance_)) {
    return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  const ViewAxes view = axes();
  const double scale = pixelsPerLength(inFront);
  const Eigen::Vector3d offset = point - focus_;
  return {0.5 * width_ + scale * offset.dot(view.right),
          0.5 * height_ - scale * offset.dot(view.up)};
}

Ray Turntable::ray(const Eigen::Vector2d& pixel) const {
  const ViewAxes view = axes();
  const double scale = pixelsPerLength(distance_);
  const Eigen::Vector3d offset = (pixel.x() - 0.5 * width_) / scale * view.right -
                                 (pixel.y() - 0.5 * height_) / scale * view.up;
  if (parallel_) return {eye() + offset, view.forward};
  return {eye(), (distance_ * view.forward + offset).normalized()};
}

Eigen::Vector3d Turntable::inViewPlane(const Eigen::Vector2d& pixel,
                                       const Eigen::Vector3d& through) const {
  const Ray sight = ray(pixel);
  const Eigen::Vector3d forward = axes().forward;
  return sight.at((through - sight.origin).dot(forward) / sight.direction.dot(forward));
}

std::array<double, 2> Turntable::clippingRange(const Bounds& bounds) const {
  // In perspective the near plane cannot reach the eye: the depth buffer's precision ends there.
  constexpr double kNearest = 0.02;  // of the distance to the focus
  double near = std::numeric_limits<double>::infinity();
  double far = -near;
  if (!bounds.empty()) {
    for (const Eigen::Vector3d& corner : bounds.corners()) {
      near = std::min(near, depth(corner));
      far = std::max(far, depth(corner));
    }
    const double slack = 0.01 * (far - near) + 1e-3 * distance_;
    near -= slack;
    far += slack;
  } else {
    near = 0.5 * distance_;
    far = 2 * distance_;
  }
  if (!parallel_) near = std::max(near, kNearest * distance_);
  return {near, std::max(far, near + distance_)};
}

}  // namespace palpa::view
