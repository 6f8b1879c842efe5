#include "bem/triangle/contact_foot.h"

#include <algorithm>

#include "bem/triangle/triangle_contact_surface.h"

namespace palpa::bem {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSingular = 1e-6;

/// Newton's step in the plane of a triangle: at x + c1 ab + c2 ac, where the smooth normal has
/// changed by c1 (n_b - n_a) + c2 (n_c - n_a), the offset to the tool is to be along the normal.
Vector2d newtonStep(const TriangleContactSurface& surface, const Vector3d& tool,
                    const SurfacePoint& at) {
  const auto& c = surface.mesh().triangles[at.triangle];
  const auto& slots = surface.slots().ofCorner[at.triangle];
  Vector3d corner[3], normal[3], sum = Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    corner[k] = surface.mesh().nodes[c[k]];
    normal[k] = surface.slots().slots[slots[k]].normal;
    sum += at.weights[k] * normal[k];
  }
  const Vector3d n = surface.normal(at), off = tool - at.position;
  const double height = off.dot(n), length = std::max(sum.norm(), kSingular);
  // Of the offset across the normal, t = off - n (n . off), by the two coordinates.
  Eigen::Matrix<double, 3, 2> change;
  for (int k = 0; k < 2; ++k) {
    const Vector3d edge = corner[k + 1] - corner[0];
    Vector3d turn = (normal[k + 1] - normal[0]) / length;
    turn -= n * n.dot(turn);
    change.col(k) = edge - n * n.dot(edge) + height * turn + n * off.dot(turn);
  }
  const Vector3d across = off - n * height;
  const Matrix2d square = change.transpose() * change;
  const double determinant = square.determinant(), trace = square.trace();
  if (!(determinant > kSingular * trace * trace)) return Vector2d::Zero();
  return square.inverse() * (change.transpose() * across);
}

}  // namespace

SurfacePoint TriangleContactSurface::foot(const Vector3d& tool, const SurfacePoint& start) const {
  // The narrowest mask limits the step: on a smooth surface the nearest point is closer to the
  // foot.
  SurfacePoint at =
      walkToFoot(mesh(), tree(), start, narrowestMask(start),
                 [&](const SurfacePoint& from) { return newtonStep(*this, tool, from); });
  at.distance = (at.position - tool).norm();
  return at;
}

}  // namespace palpa::bem
