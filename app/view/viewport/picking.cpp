#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "app/view/viewport/parts.h"

// Picking, and lengths from pixels: the const half of Viewport, and what lies under a pixel.
namespace palpa::view {
namespace {

/// A hidden handle counts as this much farther from the pointer, in parts of the reach: it can be
/// picked if no visible one is about as near.
constexpr double kHiddenPenalty = 0.5;
/// Handles whose distances to the pointer differ by less lie on top of each other, logical pixels.
constexpr double kSamePlace = 1.5;

/// Weights of a triangle's corners at a point in its plane.
Eigen::Vector3d barycentric(const Eigen::Vector3d& x, const Eigen::Vector3d& a,
                            const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const double area = normal.squaredNorm();
  if (!(area > 0)) return {1, 0, 0};
  const double ofA = (c - b).cross(x - b).dot(normal) / area,
               ofB = (a - c).cross(x - c).dot(normal) / area;
  return {ofA, ofB, 1 - ofA - ofB};
}

}  // namespace

Eigen::Vector3d Viewport::Parts::pointUnder(const Eigen::Vector2d& pixel) const {
  const Ray ray = camera.ray(pixel);
  if (const auto hit = firstHit(ray)) return ray.at(hit->distance);
  return camera.inViewPlane(pixel, camera.focus());
}

std::optional<RayHit> Viewport::Parts::firstHit(const Ray& ray) const {
  auto hit = bodyBoxes.firstHit(ray, body.positions, body.triangles);
  if (!section) return hit;
  // The part in front of the section is not there. A ray enters and leaves it at most that often.
  constexpr int kMaxHidden = 16;
  double passed = 0;
  const double step = 1e-6 * bodyDiagonal();
  for (int k = 0; hit && k < kMaxHidden; ++k) {
    const Triangle& corners = body.triangles[static_cast<std::size_t>(hit->triangle)];
    const auto at = [&](std::size_t i) { return static_cast<std::size_t>(corners[i]); };
    const Eigen::Vector3d point = ray.at(passed + hit->distance);
    const Eigen::Vector3d weights =
        barycentric(point, body.positions[at(0)], body.positions[at(1)], body.positions[at(2)]);
    double distance = 0;
    for (std::size_t i = 0; i < 3; ++i)
      distance += weights[static_cast<Eigen::Index>(i)] * section->distances[at(i)];
    if (distance <= 0) {
      hit->distance += passed;
      return hit;
    }
    passed += hit->distance + step;
    hit = bodyBoxes.firstHit({ray.at(passed), ray.direction}, body.positions, body.triangles);
  }
  return std::nullopt;
}

bool Viewport::Parts::hidden(const Eigen::Vector3d& point) const {
  // A point on the surface is not hidden by the triangles that meet there.
  constexpr double kOnSurface = 1e-3;  // of the distance
  const Ray ray = camera.ray(camera.toPixel(point));
  const double distance = (point - ray.origin).dot(ray.direction);
  const auto hit = firstHit(ray);
  return hit && hit->distance < distance - kOnSurface * camera.distance();
}

std::optional<SurfaceHit> Viewport::surfaceAt(const Eigen::Vector2d& pixel) const {
  parts_->syncSize();
  const Ray ray = parts_->camera.ray(pixel);
  const auto hit = parts_->firstHit(ray);
  if (!hit) return std::nullopt;
  return SurfaceHit{hit->triangle, ray.at(hit->distance)};
}

std::optional<SurfaceHit> Viewport::sectionAt(const Eigen::Vector2d& pixel) const {
  parts_->syncSize();
  if (!parts_->section) return std::nullopt;
  const Ray ray = parts_->camera.ray(pixel);
  const ViewportBody& face = parts_->section->face;
  const auto hit = parts_->faceBoxes.firstHit(ray, face.positions, face.triangles);
  if (!hit) return std::nullopt;
  const auto body = parts_->firstHit(ray);
  if (body && body->distance < hit->distance) return std::nullopt;
  return SurfaceHit{hit->triangle, ray.at(hit->distance)};
}

std::optional<int> Viewport::controlPointAt(const Eigen::Vector2d& pixel, double reach) const {
  parts_->syncSize();
  if (!parts_->netVisible) return std::nullopt;
  struct Candidate {
    int point;
    double distance;
    double depth;
  };
  const Turntable& camera = parts_->camera;
  const double limit = reach * parts_->inputRatio();
  std::vector<Candidate> candidates;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < parts_->net.points.size(); ++i) {
    const Eigen::Vector3d& point = parts_->net.points[i];
    double distance = (camera.toPixel(point) - pixel).norm();
    if (!(distance <= limit)) continue;  // also a point behind the eye: NaN
    if (parts_->hidden(point)) distance += kHiddenPenalty * limit;
    candidates.push_back({static_cast<int>(i), distance, camera.depth(point)});
    smallest = std::min(smallest, distance);
  }
  std::erase_if(candidates, [&](const Candidate& candidate) {
    return candidate.distance > smallest + kSamePlace * parts_->inputRatio();
  });
  const auto front =
      std::min_element(candidates.begin(), candidates.end(),
                       [](const Candidate& a, const Candidate& b) { return a.depth < b.depth; });
  if (front == candidates.end()) return std::nullopt;
  return front->point;
}

std::vector<int> Viewport::controlPointsIn(const Eigen::Vector2d& a,
                                           const Eigen::Vector2d& b) const {
  parts_->syncSize();
  const Eigen::Array2d low = a.cwiseMin(b);
  const Eigen::Array2d high = a.cwiseMax(b);
  std::vector<int> inside;
  if (!parts_->netVisible) return inside;
  for (std::size_t i = 0; i < parts_->net.points.size(); ++i) {
    const Eigen::Array2d pixel = parts_->camera.toPixel(parts_->net.points[i]);
    if ((pixel >= low).all() && (pixel <= high).all()) inside.push_back(static_cast<int>(i));
  }
  return inside;
}

std::optional<int> Viewport::borderAt(const Eigen::Vector2d& pixel, double reach) const {
  parts_->syncSize();
  const ViewportBody& body = parts_->body;
  double best = reach * parts_->inputRatio();
  std::optional<int> nearest;
  for (std::size_t line = 0; line < body.borders.size(); ++line) {
    for (std::size_t k = 1; k < body.borders[line].size(); ++k) {
      const Eigen::Vector3d& a = body.positions[body.borders[line][k - 1]];
      const Eigen::Vector3d& b = body.positions[body.borders[line][k]];
      const Eigen::Vector2d p = parts_->camera.toPixel(a);
      const Eigen::Vector2d along = parts_->camera.toPixel(b) - p;
      const double length = along.squaredNorm();
      const double s = length > 0 ? std::clamp((pixel - p).dot(along) / length, 0.0, 1.0) : 0.0;
      const double distance = (p + s * along - pixel).norm();
      if (!(distance < best) || parts_->hidden(a + s * (b - a))) continue;  // NaN: behind the eye
      best = distance;
      nearest = static_cast<int>(line);
    }
  }
  return nearest;
}

GizmoAxis Viewport::gizmoAt(const Eigen::Vector2d& pixel) const {
  parts_->syncSize();
  const std::optional<Gizmo> shown = parts_->shownGizmo(parts_->inputRatio());
  if (!shown) return GizmoAxis::kNone;
  return gizmoAxisAt(pixel, *shown, parts_->camera, parts_->inputRatio());
}

std::optional<ViewCubePart> Viewport::cubePartAt(const Eigen::Vector2d& pixel) const {
  parts_->syncSize();
  if (!parts_->viewCube.isVisible()) return std::nullopt;
  return viewCubePartAt(pixel, parts_->camera, parts_->inputRatio());
}

double Viewport::gridSpacing() const {
  parts_->syncSize();
  return view::gridSpacing(parts_->camera, parts_->inputRatio());
}

Eigen::Vector2d Viewport::toPixel(const Eigen::Vector3d& point) const {
  parts_->syncSize();
  return parts_->camera.toPixel(point);
}

Eigen::Vector3d Viewport::inViewPlane(const Eigen::Vector2d& pixel,
                                      const Eigen::Vector3d& through) const {
  parts_->syncSize();
  return parts_->camera.inViewPlane(pixel, through);
}

std::optional<Eigen::Vector3d> Viewport::onLine(const Eigen::Vector2d& pixel,
                                                const Eigen::Vector3d& through,
                                                const Eigen::Vector3d& direction) const {
  parts_->syncSize();
  const auto s = nearestOnLine(parts_->camera.ray(pixel), through, direction);
  if (!s) return std::nullopt;
  return Eigen::Vector3d(through + *s * direction);
}

}  // namespace palpa::view
