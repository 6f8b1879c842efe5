#pragma once

#include <vector>

namespace palpa::bem {

inline constexpr int kMaxSplineDegree = 5;

/// The functions of one knot span as polynomials in (t - lower) scale - 1, which runs from -1 to 1.
struct SpanPolynomials {
  int degree;
  double lower, scale;
  const double* coefficients;  ///< [power][function]
};

/// The B-spline basis functions of one direction of a patch, kept as one polynomial per function
/// and knot span, because integrals over elements evaluate them by the million.
class BsplineBasis {
 public:
  /// `knots` clamped, non-decreasing, inner multiplicity at most the degree (1 … 5); as many as
  /// functions + degree + 1. Throws std::invalid_argument.
  BsplineBasis(int degree, std::vector<double> knots);

  bool operator==(const BsplineBasis& other) const {
    return degree_ == other.degree_ && knots_ == other.knots_;
  }

  int degree() const { return degree_; }
  /// Number of functions.
  int count() const { return static_cast<int>(knots_.size()) - degree_ - 1; }
  const std::vector<double>& knots() const { return knots_; }

  /// An interval between different knots. Functions first … first + degree are not zero in it.
  struct Span {
    double lower, upper;
    int first;
  };
  const std::vector<Span>& spans() const { return spans_; }

  /// Greville abscissa: the mean of the inner knots of a function, where its coefficient weighs
  /// most.
  double greville(int function) const;

  /// Values and first derivatives (degree + 1 each) of the functions of a span. The parameter may
  /// lie outside: the polynomials go on.
  void evaluate(int span, double parameter, double* values, double* derivatives) const;

  /// The functions of a span as polynomials; valid as long as the basis.
  SpanPolynomials polynomials(int span) const;

 private:
  int degree_;
  std::vector<double> knots_;
  std::vector<Span> spans_;
  /// Per span [power][function], in a variable that runs from -1 to 1 over the span.
  std::vector<double> polynomials_;
};

}  // namespace palpa::bem
