#include "bem/triangle/kelvin.h"

#include <numbers>

namespace palpa::bem {
namespace {
using Eigen::Matrix3d;
using Eigen::Vector3d;
constexpr double kPi = std::numbers::pi;
}  // namespace

Matrix3d kelvinDisplacement(const Vector3d& x, const Vector3d& y, const Material& material) {
  const double nu = material.poissonRatio;
  const Vector3d r = y - x;
  const double distance = r.norm();
  const Vector3d e = r / distance;
  return ((3 - 4 * nu) * Matrix3d::Identity() + e * e.transpose()) /
         (16 * kPi * material.shear() * (1 - nu) * distance);
}

Matrix3d kelvinTraction(const Vector3d& x, const Vector3d& y, const Vector3d& n,
                        const Material& material) {
  const double nu = material.poissonRatio;
  const Vector3d r = y - x;
  const double distance = r.norm();
  const Vector3d e = r / distance;
  const Matrix3d symmetric =
      e.dot(n) * ((1 - 2 * nu) * Matrix3d::Identity() + 3 * e * e.transpose());
  const Matrix3d antisymmetric = (1 - 2 * nu) * (e * n.transpose() - n * e.transpose());
  return (antisymmetric - symmetric) / (8 * kPi * (1 - nu) * distance * distance);
}

Matrix3d kelvinStressFromTraction(const Vector3d& x, const Vector3d& y, const Vector3d& p,
                                  const Material& material) {
  // D_kij p_k = 1 / (8 pi (1-nu) R^2) [ (1-2nu)(e_j p_i + e_i p_j - delta_ij e.p) + 3 e_i e_j e.p
  // ], with e pointing from the interior point x to the boundary point y.
  const double nu = material.poissonRatio;
  const Vector3d r = y - x;
  const double squared = r.squaredNorm();
  const Vector3d e = r / std::sqrt(squared);
  const double along = e.dot(p);
  const Matrix3d shearPart = e * p.transpose() + p * e.transpose() - along * Matrix3d::Identity();
  return ((1 - 2 * nu) * shearPart + 3 * along * e * e.transpose()) /
         (8 * kPi * (1 - nu) * squared);
}

Matrix3d kelvinStressFromDisplacement(const Vector3d& x, const Vector3d& y, const Vector3d& n,
                                      const Vector3d& u, const Material& material) {
  // S_kij u_k = G / (4 pi (1-nu) R^3) { 3 (e.n) [ (1-2nu) delta_ij e.u + nu (e_j u_i + e_i u_j) - 5
  // e_i e_j e.u ]
  //   + 3 nu (n_i e_j e.u + n_j e_i e.u) + (1-2nu)(3 (n.u) e_i e_j + n_j u_i + n_i u_j) - (1-4nu)
  //   delta_ij n.u }
  const double nu = material.poissonRatio;
  const Vector3d r = y - x;
  const double distance = r.norm();
  const Vector3d e = r / distance;
  const double eu = e.dot(u), en = e.dot(n), un = u.dot(n);
  const Matrix3d identity = Matrix3d::Identity();
  const Matrix3d ee = e * e.transpose();
  const Matrix3d eu2 = e * u.transpose() + u * e.transpose();
  const Matrix3d en2 = e * n.transpose() + n * e.transpose();
  const Matrix3d un2 = u * n.transpose() + n * u.transpose();
  const Matrix3d kernel = 3 * en * ((1 - 2 * nu) * eu * identity + nu * eu2 - 5 * eu * ee) +
                          3 * nu * eu * en2 + (1 - 2 * nu) * (3 * un * ee + un2) -
                          (1 - 4 * nu) * un * identity;
  return -material.shear() / (4 * kPi * (1 - nu) * distance * distance * distance) * kernel;
}

}  // namespace palpa::bem
