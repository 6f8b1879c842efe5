#include "bem/spline/bspline_basis.h"

#include <Eigen/Dense>
#include <array>
#include <numbers>
#include <stdexcept>

namespace palpa::bem {
namespace {

using Values = std::array<double, kMaxSplineDegree + 1>;

/// Basis functions at t by the recursion of Cox and de Boor (de Boor, A Practical Guide to Splines,
/// 1978, chapter X) in the span that begins at knots[index].
Values coxDeBoor(const std::vector<double>& knots, int degree, int index, double t) {
  Values value{1.0};
  for (int p = 1; p <= degree; ++p) {
    double carried = 0;
    for (int k = 0; k < p; ++k) {
      const double left = knots[index + 1 + k - p], right = knots[index + 1 + k];
      const double share = value[k] / (right - left);
      value[k] = carried + (right - t) * share;
      carried = (t - left) * share;
    }
    value[p] = carried;
  }
  return value;
}

}  // namespace

BsplineBasis::BsplineBasis(int degree, std::vector<double> knots)
    : degree_(degree), knots_(std::move(knots)) {
  const int size = degree + 1;
  if (degree < 1 || degree > kMaxSplineDegree || static_cast<int>(knots_.size()) < 2 * size)
    throw std::invalid_argument("BsplineBasis: degree or number of knots out of range");
  for (int k = degree; k + size < static_cast<int>(knots_.size()); ++k)
    if (knots_[k] < knots_[k + 1]) spans_.push_back({knots_[k], knots_[k + 1], k - degree});
  if (spans_.empty()) throw std::invalid_argument("BsplineBasis: the knots do not increase");

  // Interpolating the values of the recursion yields the polynomials.
  Eigen::MatrixXd powers(size, size);
  Eigen::VectorXd nodes(size);
  for (int k = 0; k < size; ++k) {
    nodes[k] = -std::cos(std::numbers::pi * (k + 0.5) / size);
    for (int m = 0; m < size; ++m) powers(k, m) = std::pow(nodes[k], m);
  }
  const Eigen::PartialPivLU<Eigen::MatrixXd> interpolate(powers);
  for (const Span& span : spans_) {
    Eigen::MatrixXd values(size, size);
    for (int k = 0; k < size; ++k) {
      const double t = (span.lower + span.upper + nodes[k] * (span.upper - span.lower)) / 2;
      const Values row = coxDeBoor(knots_, degree, span.first + degree, t);
      for (int f = 0; f < size; ++f) values(k, f) = row[f];
    }
    const Eigen::MatrixXd coefficients = interpolate.solve(values);
    for (int m = 0; m < size; ++m)
      for (int f = 0; f < size; ++f) polynomials_.push_back(coefficients(m, f));
  }
}

double BsplineBasis::greville(int function) const {
  double sum = 0;
  for (int k = 1; k <= degree_; ++k) sum += knots_[function + k];
  return sum / degree_;
}

SpanPolynomials BsplineBasis::polynomials(int span) const {
  const int size = degree_ + 1;
  return {degree_, spans_[span].lower, 2 / (spans_[span].upper - spans_[span].lower),
          polynomials_.data() + static_cast<std::ptrdiff_t>(span) * size * size};
}

void BsplineBasis::evaluate(int span, double parameter, double* values, double* derivatives) const {
  const int size = degree_ + 1;
  const SpanPolynomials p = polynomials(span);
  const double s = (parameter - p.lower) * p.scale - 1;
  for (int f = 0; f < size; ++f) {
    double value = p.coefficients[degree_ * size + f], slope = 0;
    for (int m = degree_ - 1; m >= 0; --m) {
      slope = slope * s + value;
      value = value * s + p.coefficients[m * size + f];
    }
    values[f] = value;
    derivatives[f] = slope * p.scale;
  }
}

}  // namespace palpa::bem
