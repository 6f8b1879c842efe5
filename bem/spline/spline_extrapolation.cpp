#include "bem/spline/spline_extrapolation.h"

#include <Eigen/LU>
#include <vector>

namespace palpa::bem {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Coefficients of the monomials 1, t, t^2, … in a function's coefficient: their blossoms at its
/// knots.
VectorXd blossoms(const BsplineBasis& basis, int function, int order) {
  const int degree = basis.degree();
  const double begin = basis.knots().front(), length = basis.knots().back() - begin;
  std::vector<double> symmetric(static_cast<std::size_t>(degree) + 1, 0);
  symmetric[0] = 1;
  for (int k = 1; k <= degree; ++k) {
    const double t = (basis.knots()[function + k] - begin) / length;
    for (int m = k; m > 0; --m) symmetric[m] += t * symmetric[m - 1];
  }
  VectorXd result(order + 1);
  double binomial = 1;
  for (int m = 0; m <= order; ++m) {
    result[m] = symmetric[m] / binomial;
    binomial = binomial * (degree - m) / (m + 1);
  }
  return result;
}

}  // namespace

VectorXd extrapolationWeights(const BsplineBasis& basis, int first, int order, int function) {
  if (function >= first && function <= first + order)
    return VectorXd::Unit(order + 1, function - first);
  MatrixXd matrix(order + 1, order + 1);
  for (int k = 0; k <= order; ++k) matrix.col(k) = blossoms(basis, first + k, order);
  return matrix.partialPivLu().solve(blossoms(basis, function, order));
}

}  // namespace palpa::bem
