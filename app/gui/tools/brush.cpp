#include "app/gui/tools/brush.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpa::gui {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr int kPiecesPerTurn = 72;

/// Intersections of the segment a b with the sphere: up to two fractions in 0 … 1, ascending.
std::vector<double> crossings(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                              const Eigen::Vector3d& centre, double radius) {
  const Eigen::Vector3d along = b - a;
  const Eigen::Vector3d from = a - centre;
  const double p = along.squaredNorm();
  const double q = from.dot(along);
  const double discriminant = q * q - p * (from.squaredNorm() - radius * radius);
  if (p == 0.0 || discriminant <= 0.0) return {};
  std::vector<double> result;
  for (double sign : {-1.0, 1.0}) {
    const double t = (-q + sign * std::sqrt(discriminant)) / p;
    if (t >= 0.0 && t <= 1.0) result.push_back(t);
  }
  return result;
}

/// The circle in which a sphere cuts the plane of a triangle.
class Circle {
 public:
  Circle(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3d& normal,
         const Eigen::Vector3d& foot, double radius)
      : corners_(corners),
        normal_(normal),
        foot_(foot),
        x_((corners[1] - corners[0]).normalized() * radius),
        y_(normal.cross(x_)) {}

  Eigen::Vector3d at(double angle) const {
    return foot_ + std::cos(angle) * x_ + std::sin(angle) * y_;
  }
  double angleOf(const Eigen::Vector3d& point) const {
    return std::atan2((point - foot_).dot(y_), (point - foot_).dot(x_));
  }
  bool isInTriangle(double angle) const {
    for (int i = 0; i < 3; ++i)
      if ((corners_[(i + 1) % 3] - corners_[i]).cross(at(angle) - corners_[i]).dot(normal_) < 0.0)
        return false;
    return true;
  }
  std::vector<Eigen::Vector3d> arc(double from, double to) const {
    const int pieces =
        std::max(1, static_cast<int>(std::ceil((to - from) / kTurn * kPiecesPerTurn)));
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i <= pieces; ++i) points.push_back(at(from + (to - from) * i / pieces));
    return points;
  }

 private:
  std::array<Eigen::Vector3d, 3> corners_;
  Eigen::Vector3d normal_, foot_, x_, y_;
};

void addArcs(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3d& centre,
             double radius, std::vector<std::vector<Eigen::Vector3d>>& lines) {
  const Eigen::Vector3d cross = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  if (cross.norm() == 0.0) return;
  const Eigen::Vector3d normal = cross.normalized();
  const double height = normal.dot(centre - corners[0]);
  if (std::abs(height) >= radius) return;
  const Circle circle(corners, normal, centre - height * normal,
                      std::sqrt(radius * radius - height * height));
  std::vector<double> angles;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d& a = corners[i];
    const Eigen::Vector3d& b = corners[(i + 1) % 3];
    for (double t : crossings(a, b, centre, radius))
      angles.push_back(circle.angleOf(a + t * (b - a)));
  }
  if (angles.empty()) {
    if (circle.isInTriangle(0.0)) lines.push_back(circle.arc(0.0, kTurn));
    return;
  }
  std::sort(angles.begin(), angles.end());
  angles.push_back(angles.front() + kTurn);
  for (std::size_t i = 1; i < angles.size(); ++i)
    if (angles[i] - angles[i - 1] > 1e-12 && circle.isInTriangle(0.5 * (angles[i - 1] + angles[i])))
      lines.push_back(circle.arc(angles[i - 1], angles[i]));
}

}  // namespace

std::vector<std::vector<Eigen::Vector3d>> ringOnSurface(const ShownSurface& surface,
                                                        const Eigen::Vector3d& centre,
                                                        double radius) {
  std::vector<std::vector<Eigen::Vector3d>> lines;
  for (const auto& [a, b, c] : surface.triangles) {
    const std::array corners{surface.positions[a], surface.positions[b], surface.positions[c]};
    const Eigen::Vector3d low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
    const Eigen::Vector3d high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
    if (((low - centre).array() > radius).any() || ((centre - high).array() > radius).any())
      continue;
    addArcs(corners, centre, radius, lines);
  }
  return lines;
}

std::vector<modeling::Stroke> withoutNear(const modeling::Stroke& stroke,
                                          const Eigen::Vector3d& centre, double radius) {
  const double reach = std::max(radius, stroke.radius);
  const auto isNear = [&](const Eigen::Vector3d& point) { return (point - centre).norm() < reach; };
  std::vector<modeling::Stroke> pieces;
  modeling::Stroke piece{{}, stroke.radius};
  const auto finish = [&] {
    if (!piece.points.empty()) pieces.push_back(piece);
    piece.points.clear();
  };
  for (std::size_t i = 0; i < stroke.points.size(); ++i) {
    const Eigen::Vector3d& point = stroke.points[i];
    if (i > 0) {
      const Eigen::Vector3d& before = stroke.points[i - 1];
      for (double t : crossings(before, point, centre, reach)) {
        const Eigen::Vector3d crossing = before + t * (point - before);
        const bool leaves = (crossing - centre).dot(point - before) > 0.0;
        if (leaves) piece.points.clear();
        piece.points.push_back(crossing);
        if (!leaves) finish();
      }
    }
    if (isNear(point))
      finish();
    else
      piece.points.push_back(point);
  }
  finish();
  return pieces;
}

}  // namespace palpa::gui
