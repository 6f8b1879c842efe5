#include "modeling/mesh/surface_mesh.h"

#include <cmath>
#include <numbers>

#include "modeling/mesh/triangle_shape.h"

namespace palpa::modeling {

MeshQuality measureQuality(const SurfaceMesh& mesh) {
  MeshQuality quality;
  double smallest = std::numbers::pi;
  double sum = 0.0;
  quality.shortestEdge = mesh.triangles.empty() ? 0.0 : HUGE_VAL;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d& p = mesh.positions[a];
    const Eigen::Vector3d& q = mesh.positions[b];
    const Eigen::Vector3d& r = mesh.positions[c];
    double longest = 0.0;
    for (double length : {(q - p).norm(), (r - q).norm(), (p - r).norm()}) {
      quality.shortestEdge = std::min(quality.shortestEdge, length);
      longest = std::max(longest, length);
      sum += length;
    }
    quality.longestEdge = std::max(quality.longestEdge, longest);
    const double doubleArea = (q - p).cross(r - p).norm();
    quality.largestAspect =
        std::max(quality.largestAspect, 0.5 * std::numbers::sqrt3 * longest * longest / doubleArea);
    smallest = std::min(smallest, smallestAngle(p, q, r));
  }
  if (mesh.triangles.empty()) return quality;
  quality.meanEdge = sum / (3.0 * static_cast<double>(mesh.triangles.size()));
  quality.smallestAngle = smallest * 180.0 / std::numbers::pi;
  return quality;
}

}  // namespace palpa::modeling
