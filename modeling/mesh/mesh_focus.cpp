#include "modeling/mesh/mesh_focus.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "modeling/mesh/mesh_refine.h"

namespace palpa::modeling {

using Eigen::Vector3d;

bool isAtFocus(const MeshFocus& focus, const Vector3d& a, const Vector3d& b) {
  const Vector3d along = b - a;
  const double length = along.squaredNorm();
  const double t = length > 0 ? std::clamp((focus.center - a).dot(along) / length, 0.0, 1.0) : 0.0;
  return (a + t * along - focus.center).norm() <= focus.radius / 2;
}

bool isAtFocus(const MeshFocus& focus, const std::array<Vector3d, 3>& triangle) {
  const Vector3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
  double longest = 0;
  for (int k = 0; k < 3; ++k) {
    const Vector3d edge = triangle[(k + 1) % 3] - triangle[k];
    if (normal.dot(edge.cross(focus.center - triangle[k])) < 0) return false;
    longest = std::max(longest, edge.norm());
  }
  return std::abs(normal.dot(focus.center - triangle[0])) <= longest / 2;
}

double focusNodes(std::span<const MeshFocus> foci, double edgeLength, double areaPerNode) {
  constexpr double g = kSizeGrowth;
  const double h = edgeLength;
  double sum = 0;
  for (const auto& [center, radius, a] : foci) {
    if (a >= h) continue;
    // The disc with the radius r of the constant length a, then l = a + g (s - r) up to h.
    const double r = radius / 2, end = r + (h - a) / g;
    const double c = a - g * r;  // l = c + g s
    const double ring = (std::log(h / a) + c / h - c / a) / (g * g);
    sum += std::numbers::pi * (r * r / (a * a) + 2 * ring - end * end / (h * h)) / areaPerNode;
  }
  return sum;
}

}  // namespace palpa::modeling
