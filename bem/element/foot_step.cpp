#include "bem/element/foot_step.h"

namespace palpa::bem {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

Vector2d stepToFoot(const SurfaceJet2& jet, const Vector3d& tool) {
  const Vector3d off = tool - jet.position;
  const Vector2d right(off.dot(jet.u), off.dot(jet.v));
  Matrix2d metric, bend;
  metric << jet.u.squaredNorm(), jet.u.dot(jet.v), jet.u.dot(jet.v), jet.v.squaredNorm();
  bend << off.dot(jet.uu), off.dot(jet.uv), off.dot(jet.uv), off.dot(jet.vv);
  constexpr double kSingular = 1e-6;
  const auto isDefinite = [&](const Matrix2d& matrix) {
    return matrix.trace() > 0 && matrix.determinant() > kSingular * metric(0, 0) * metric(1, 1);
  };
  if (isDefinite(metric - bend)) return (metric - bend).inverse() * right;
  if (isDefinite(metric)) return metric.inverse() * right;
  return Vector2d::Zero();
}

}  // namespace palpa::bem
