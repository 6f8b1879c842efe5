#include "bem/base/gauss_rule.h"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <stdexcept>

namespace palpa::bem {
namespace {

/// Gauss rule by Golub and Welsch, Math. Comp. 23 (1969) 221-230: the points are the eigenvalues of
/// the Jacobi matrix of the Legendre polynomials.
GaussRule makeRule(int count) {
  Eigen::VectorXd beside(std::max(count - 1, 1));
  for (int k = 1; k < count; ++k) beside[k - 1] = k / std::sqrt(4.0 * k * k - 1);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::VectorXd::Zero(count), beside.head(count - 1));
  GaussRule rule;
  for (int k = 0; k < count; ++k) {
    rule.points.push_back((1 + solver.eigenvalues()[k]) / 2);
    rule.weights.push_back(solver.eigenvectors()(0, k) * solver.eigenvectors()(0, k));
  }
  return rule;
}

}  // namespace

const GaussRule& gaussRule(int count) {
  static const auto rules = [] {
    std::array<GaussRule, kMaxGaussPoints + 1> all;
    for (int k = 1; k <= kMaxGaussPoints; ++k) all[k] = makeRule(k);
    return all;
  }();
  if (count < 1 || count > kMaxGaussPoints)
    throw std::out_of_range("gaussRule: the number of points is out of range");
  return rules[count];
}

}  // namespace palpa::bem
