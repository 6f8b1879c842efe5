#include "axisymmetric_sphere.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpa::app::test {
namespace {

using Eigen::Index;
using Eigen::Matrix2d;
using Eigen::Vector2d;

/// Ends of elements on [from, to], graded towards `to`, none longer than `longest`, with middles.
std::vector<double> graded(double from, double to, int levels, double longest) {
  constexpr double kRatio = 0.6;
  std::vector<double> ends{from};
  double left = to - from;
  for (int level = 0; level < levels; ++level) {
    const double next = level + 1 < levels ? left * kRatio : 0;
    const int parts = std::max(1, static_cast<int>(std::ceil(std::abs(left - next) / longest)));
    const double begin = ends.back(), end = to - next;
    for (int k = 1; k <= parts; ++k) {
      ends.push_back(begin + (k - 0.5) / parts * (end - begin));
      ends.push_back(begin + static_cast<double>(k) / parts * (end - begin));
    }
    left = next;
  }
  return ends;
}

constexpr double kGauss[4] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                              0.8611363115940526};
constexpr double kWeight[4] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                               0.3478548451374538};

void quadratic(double s, double (&value)[3], double (&slope)[3]) {
  value[0] = s * (s - 1) / 2;
  value[1] = 1 - s * s;
  value[2] = s * (s + 1) / 2;
  slope[0] = s - 0.5;
  slope[1] = -2 * s;
  slope[2] = s + 0.5;
}

}  // namespace

AxisymmetricSphere::AxisymmetricSphere(double radius, double fixedBelow,
                                       const bem::Material& material, double weight, int levels) {
  const double rim = std::acos(-fixedBelow / radius);
  angles_ = graded(0, rim, levels, 0.08);
  std::vector<double> above = graded(std::numbers::pi, rim, levels, 0.08);
  angles_.insert(angles_.end(), above.rbegin() + 1, above.rend());
  radii_ = graded(0, radius, levels, 0.08 * radius);
  alongSize_ = static_cast<int>(angles_.size());
  const int across = static_cast<int>(radii_.size());
  const auto place = [&](int i, int j) {
    return Vector2d(radii_[j] * std::sin(angles_[i]), -radii_[j] * std::cos(angles_[i]));
  };

  const double nu = material.poissonRatio, mu = material.shear();
  const double lambda = 2 * mu * nu / (1 - 2 * nu);
  Eigen::Matrix4d hooke = Eigen::Matrix4d::Zero();  // of rr, zz, θθ, rz
  hooke.topLeftCorner<3, 3>().setConstant(lambda);
  hooke.diagonal() << lambda + 2 * mu, lambda + 2 * mu, lambda + 2 * mu, mu;

  const int nodes = 1 + alongSize_ * (across - 1);
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(2 * nodes);
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j + 2 < across; j += 2)
    for (int i = 0; i + 2 < alongSize_; i += 2) {
      Eigen::Matrix<double, 18, 18> stiffness = Eigen::Matrix<double, 18, 18>::Zero();
      Eigen::Matrix<double, 18, 1> load = Eigen::Matrix<double, 18, 1>::Zero();
      int index[9];
      for (int b = 0; b < 3; ++b)
        for (int a = 0; a < 3; ++a) index[3 * b + a] = node(i + a, j + b);
      for (int q = 0; q < 16; ++q) {
        double n[2][3], d[2][3];
        quadratic(kGauss[q % 4], n[0], d[0]);
        quadratic(kGauss[q / 4], n[1], d[1]);
        Matrix2d jacobian = Matrix2d::Zero();
        Vector2d at = Vector2d::Zero();
        for (int b = 0; b < 3; ++b)
          for (int a = 0; a < 3; ++a) {
            const Vector2d x = place(i + a, j + b);
            at += n[0][a] * n[1][b] * x;
            jacobian.col(0) += d[0][a] * n[1][b] * x;
            jacobian.col(1) += n[0][a] * d[1][b] * x;
          }
        const Matrix2d inverse = jacobian.inverse();
        const double size = kWeight[q % 4] * kWeight[q / 4] * std::abs(jacobian.determinant()) * 2 *
                            std::numbers::pi * at[0];
        Eigen::Matrix<double, 4, 18> strain = Eigen::Matrix<double, 4, 18>::Zero();
        for (int k = 0; k < 9; ++k) {
          const int a = k % 3, b = k / 3;
          const Vector2d slope =
              inverse.transpose() * Vector2d(d[0][a] * n[1][b], n[0][a] * d[1][b]);
          strain(0, 2 * k) = slope[0];
          strain(1, 2 * k + 1) = slope[1];
          strain(2, 2 * k) = n[0][a] * n[1][b] / at[0];
          strain(3, 2 * k) = slope[1];
          strain(3, 2 * k + 1) = slope[0];
          load[2 * k + 1] -= size * weight * n[0][a] * n[1][b];
        }
        stiffness += size * strain.transpose() * hooke * strain;
        volume_ += size;
      }
      for (int a = 0; a < 18; ++a) {
        const int row = 2 * index[a / 2] + a % 2;
        forces[row] += load[a];
        for (int b = 0; b < 18; ++b)
          entries.emplace_back(row, 2 * index[b / 2] + b % 2, stiffness(a, b));
      }
    }

  std::vector<bool> isFixed(2 * nodes, false);
  isFixed[0] = true;
  for (int j = 1; j < across; ++j)
    isFixed[2 * node(0, j)] = isFixed[2 * node(alongSize_ - 1, j)] = true;
  for (int i = 0; i < alongSize_ && angles_[i] <= rim + 1e-12; ++i)
    isFixed[2 * node(i, across - 1)] = isFixed[2 * node(i, across - 1) + 1] = true;
  std::vector<int> unknown(2 * nodes, -1);
  int count = 0;
  for (int k = 0; k < 2 * nodes; ++k)
    if (!isFixed[k]) unknown[k] = count++;
  std::vector<Eigen::Triplet<double>> some;
  for (const auto& entry : entries)
    if (unknown[entry.row()] >= 0 && unknown[entry.col()] >= 0)
      some.emplace_back(unknown[entry.row()], unknown[entry.col()], entry.value());
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(some.begin(), some.end());
  Eigen::VectorXd right(count);
  for (int k = 0; k < 2 * nodes; ++k)
    if (unknown[k] >= 0) right[unknown[k]] = forces[k];
  const Eigen::VectorXd solution =
      Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(right);
  u_ = Eigen::VectorXd::Zero(2 * nodes);
  for (int k = 0; k < 2 * nodes; ++k)
    if (unknown[k] >= 0) u_[k] = solution[unknown[k]];
  energy_ = forces.dot(u_) / 2;
}

Vector2d AxisymmetricSphere::surfaceDisplacement(double& angle) const {
  const auto nearest = std::min_element(angles_.begin(), angles_.end(), [&](double a, double b) {
    return std::abs(a - angle) < std::abs(b - angle);
  });
  angle = *nearest;
  const int k =
      node(static_cast<int>(nearest - angles_.begin()), static_cast<int>(radii_.size()) - 1);
  return u_.segment<2>(2 * static_cast<Index>(k));
}

}  // namespace palpa::app::test
