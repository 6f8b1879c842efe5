#include "bem/triangle/flat_triangle.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace palpa::bem {
namespace {

void copy(const Eigen::Vector3d& from, double (&to)[3]) {
  for (int i = 0; i < 3; ++i) to[i] = from[i];
}

}  // namespace

FlatTriangle makeFlatTriangle(const double (&positions)[3][3]) {
  FlatTriangle t{};
  const Eigen::Vector3d a(positions[0]), b(positions[1]), c(positions[2]);
  const Eigen::Vector3d first = (b - a).normalized();
  const Eigen::Vector3d cross = (b - a).cross(c - a);
  const Eigen::Vector3d normal = cross.normalized();
  const Eigen::Vector3d second = normal.cross(first);
  const Eigen::Vector3d centroid = (a + b + c) / 3.0;
  copy(a, t.origin);
  copy(first, t.axis[0]);
  copy(second, t.axis[1]);
  copy(normal, t.normal);
  copy(centroid, t.centroid);
  t.area = 0.5 * cross.norm();
  const Eigen::Vector3d corners[3] = {a, b, c};
  for (int k = 0; k < 3; ++k) {
    t.radius = std::max(t.radius, (corners[k] - centroid).norm());
    t.corner[k][0] = (corners[k] - a).dot(first);
    t.corner[k][1] = (corners[k] - a).dot(second);
  }
  t.corner[1][1] = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double* from = t.corner[k];
    const double* to = t.corner[(k + 1) % 3];
    const double dx = to[0] - from[0], dy = to[1] - from[1];
    t.length[k] = std::hypot(dx, dy);
    t.tangent[k][0] = dx / t.length[k];
    t.tangent[k][1] = dy / t.length[k];
    // The basis function of the corner opposite to this edge grows along the edge's inward normal.
    const int opposite = (k + 2) % 3;
    t.gradient[opposite][0] = -dy / (2 * t.area);
    t.gradient[opposite][1] = dx / (2 * t.area);
  }
  return t;
}

}  // namespace palpa::bem
