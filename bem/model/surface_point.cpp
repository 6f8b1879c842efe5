#include "bem/model/surface_point.h"

#include <algorithm>
#include <limits>

namespace palpa::bem {
namespace {

using Eigen::Vector3d;

/// Barycentric coordinates of the point of a segment nearest to x.
double nearestOnSegment(const Vector3d& a, const Vector3d& b, const Vector3d& x) {
  return std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
}

/// Inside the triangle's prism the foot of the perpendicular, otherwise the nearest point of an
/// edge.
Vector3d nearestWeights(const Vector3d (&c)[3], const Vector3d& x) {
  const Vector3d cross = (c[1] - c[0]).cross(c[2] - c[0]);
  Vector3d weights;
  for (int k = 0; k < 3; ++k) {
    const Vector3d& p = c[(k + 1) % 3];
    const Vector3d& q = c[(k + 2) % 3];
    weights[k] = (q - p).cross(x - p).dot(cross) / cross.squaredNorm();
  }
  if (weights.minCoeff() >= 0) return weights;
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const double s = nearestOnSegment(c[k], c[next], x);
    const double distance = ((1 - s) * c[k] + s * c[next] - x).squaredNorm();
    if (distance < best) {
      best = distance;
      weights = (1 - s) * Vector3d::Unit(k) + s * Vector3d::Unit(next);
    }
  }
  return weights;
}

}  // namespace

SurfacePoint nearestOnTriangle(const BoundaryMesh& mesh, int triangle, const Vector3d& point) {
  const auto& c = mesh.triangles[triangle];
  const Vector3d corners[3] = {mesh.nodes[c[0]], mesh.nodes[c[1]], mesh.nodes[c[2]]};
  const Vector3d weights = nearestWeights(corners, point);
  const Vector3d position = mesh.point(triangle, weights);
  return {triangle, weights, position, (position - point).norm()};
}

SurfacePoint nearestSurfacePoint(const BoundaryMesh& mesh, const Vector3d& point) {
  SurfacePoint best{-1, Vector3d::Zero(), Vector3d::Zero(),
                    std::numeric_limits<double>::infinity()};
  for (int t = 0; t < mesh.triangleCount(); ++t) {
    const SurfacePoint found = nearestOnTriangle(mesh, t, point);
    if (found.distance < best.distance) best = found;
  }
  return best;
}

int nearestNode(const BoundaryMesh& mesh, const Vector3d& point) {
  const auto nearer = [&](const Vector3d& a, const Vector3d& b) {
    return (a - point).squaredNorm() < (b - point).squaredNorm();
  };
  return static_cast<int>(std::min_element(mesh.nodes.begin(), mesh.nodes.end(), nearer) -
                          mesh.nodes.begin());
}

}  // namespace palpa::bem
