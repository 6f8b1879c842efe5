#include "bem/model/body_force.h"

#include <numbers>

namespace palpa::bem {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d bodyForceDisplacement(const Vector3d& r, const Vector3d& area, const Bulk& bulk) {
  const Vector3d e = r.normalized();
  const Vector3d& b = bulk.bodyForce;
  return (e.dot(area) * b - b.dot(area) / (2 * (1 - bulk.material.poissonRatio)) * e) /
         (8 * std::numbers::pi * bulk.material.shear());
}

Matrix3d bodyForceStress(const Vector3d& r, const Vector3d& area, const Bulk& bulk) {
  const double nu = bulk.material.poissonRatio, distance = r.norm();
  const Vector3d e = r / distance;
  const Vector3d& b = bulk.bodyForce;
  const Matrix3d along = b * e.transpose(), across = b * area.transpose();
  const Matrix3d normal = ((1 - 2 * nu) * Matrix3d::Identity() - e * e.transpose()) / (1 - nu);
  return (b.dot(area) * normal - across - across.transpose() +
          e.dot(area) * (along + along.transpose())) /
         (8 * std::numbers::pi * distance);
}

ParticularState particularState(const Vector3d& fromCentre, const Vector3d& normal,
                                const Bulk& bulk) {
  const Vector3d direction = bulk.bodyForce.normalized();
  const Vector3d across = fromCentre - fromCentre.dot(direction) * direction;
  return {-across.squaredNorm() / (4 * bulk.material.shear()) * bulk.bodyForce,
          -(across.dot(normal) * bulk.bodyForce + bulk.bodyForce.dot(normal) * across) / 2};
}

Matrix3d particularGradient(const Vector3d& fromCentre, const Bulk& bulk) {
  const Vector3d direction = bulk.bodyForce.normalized();
  const Vector3d across = fromCentre - fromCentre.dot(direction) * direction;
  return -bulk.bodyForce * across.transpose() / (2 * bulk.material.shear());
}

Matrix3d particularStress(const Vector3d& fromCentre, const Bulk& bulk) {
  const Matrix3d gradient = particularGradient(fromCentre, bulk);
  return bulk.material.shear() * (gradient + gradient.transpose());
}

double particularWork(const VolumeMoments& moments, const Bulk& bulk) {
  const Matrix3d second = moments.secondMoments();
  const Vector3d& b = bulk.bodyForce;
  return -(b.squaredNorm() * second.trace() - b.dot(second * b)) / (4 * bulk.material.shear());
}

}  // namespace palpa::bem
