#include "app/verification/exact/textbook_fields.h"

#include <cmath>

namespace palpa::verification {

using Eigen::Matrix3d;
using Eigen::Vector3d;

ExactField pressurisedSphereField(double inner, double outer, double pressure,
                                  const bem::Material& material, const Vector3d& centre) {
  const double nu = material.poissonRatio, outerCubed = std::pow(outer, 3);
  // σ_r = scale (1 - b^3 / r^3), σ_θ = scale (1 + b^3 / 2 r^3).
  const double scale = pressure * std::pow(inner, 3) / (outerCubed - std::pow(inner, 3));
  return {[=, youngs = material.youngsModulus](const Vector3d& x) {
            const Vector3d from = x - centre;
            const double ratio = outerCubed / std::pow(from.norm(), 3);
            return Vector3d(scale / youngs * (1 - 2 * nu + (1 + nu) / 2 * ratio) * from);
          },
          [=](const Vector3d& x) {
            const Vector3d radial = (x - centre).normalized();
            const double ratio = outerCubed / std::pow((x - centre).norm(), 3);
            const double along = scale * (1 - ratio), across = scale * (1 + ratio / 2);
            return Matrix3d(across * Matrix3d::Identity() +
                            (along - across) * radial * radial.transpose());
          }};
}

ExactField bendingField(double curvature, const bem::Material& material) {
  const double nu = material.poissonRatio;
  return {[=](const Vector3d& x) {
            return Vector3d(-curvature * x.x() * x.z(), nu * curvature * x.y() * x.z(),
                            curvature / 2 * (x.x() * x.x() + nu * (x.z() * x.z() - x.y() * x.y())));
          },
          [=, youngs = material.youngsModulus](const Vector3d& x) {
            Matrix3d stress = Matrix3d::Zero();
            stress(0, 0) = -youngs * curvature * x.z();
            return stress;
          }};
}

}  // namespace palpa::verification
