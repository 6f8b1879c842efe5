#include "app/verification/exact/exact_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bem/triangle/kelvin.h"

namespace palpa::verification {
using namespace bem;
using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d hooke(const Matrix3d& gradient, const Material& material) {
  const double nu = material.poissonRatio, shear = material.shear();
  const Matrix3d strain = (gradient + gradient.transpose()) / 2;
  return 2 * shear * (strain + nu / (1 - 2 * nu) * strain.trace() * Matrix3d::Identity());
}

ExactField linearField(const Matrix3d& gradient, const Vector3d& shift, const Material& material,
                       double pressure) {
  const Matrix3d stress = material.poissonRatio == 0.5
                              ? Matrix3d(material.shear() * (gradient + gradient.transpose()) -
                                         pressure * Matrix3d::Identity())
                              : hooke(gradient, material);
  return {[=](const Vector3d& x) { return Vector3d(gradient * x + shift); },
          [=](const Vector3d&) { return stress; }};
}

ExactField kelvinField(const Vector3d& source, const Vector3d& force, const Material& material) {
  return {[=](const Vector3d& x) {
            return Vector3d(kelvinDisplacement(source, x, material).transpose() * force);
          },
          [=](const Vector3d& x) {
            Matrix3d stress;
            for (int k = 0; k < 3; ++k)
              stress.col(k) =
                  kelvinTraction(source, x, Vector3d::Unit(k), material).transpose() * force;
            return stress;
          }};
}

ExactField hangingBarField(const Vector3d& bodyForce, const Vector3d& end,
                           const Material& material) {
  // Timoshenko & Goodier, Theory of Elasticity, "stretching of a prismatical bar by its own
  // weight".
  const double load = bodyForce.norm(), modulus = material.youngsModulus,
               nu = material.poissonRatio;
  const Vector3d along = bodyForce / load;
  return {[=](const Vector3d& x) {
            const double s = along.dot(x - end);
            const Vector3d across = x - end - s * along;
            return Vector3d(load / modulus *
                            (nu * s * across - (s * s + nu * across.squaredNorm()) / 2 * along));
          },
          [=](const Vector3d& x) {
            return Matrix3d(-load * along.dot(x - end) * along * along.transpose());
          },
          bodyForce};
}

ExactField sum(const ExactField& a, const ExactField& b) {
  return {[=](const Vector3d& x) { return Vector3d(a.displacement(x) + b.displacement(x)); },
          [=](const Vector3d& x) { return Matrix3d(a.stress(x) + b.stress(x)); },
          a.bodyForce + b.bodyForce};
}

Matrix3d generalGradient(bool traceless) {
  Matrix3d gradient;
  gradient << 0.011, -0.004, 0.006, 0.009, -0.007, 0.003, -0.002, 0.008, 0.005;
  if (traceless) gradient -= gradient.trace() / 3 * Matrix3d::Identity();
  return gradient;
}

Matrix3d differences(const std::function<Vector3d(const Vector3d&)>& f, const Vector3d& at,
                     double step) {
  Matrix3d gradient;
  for (int j = 0; j < 3; ++j) {
    const Vector3d h = step * Vector3d::Unit(j);
    gradient.col(j) = (8 * (f(at + h) - f(at - h)) - (f(at + 2 * h) - f(at - 2 * h))) / (12 * step);
  }
  return gradient;
}

double worse(double error, double other) {
  if (std::isnan(error) || std::isnan(other)) return std::numeric_limits<double>::infinity();
  return std::max(error, other);
}

}  // namespace palpa::verification
