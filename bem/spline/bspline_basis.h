#pragma once

#include <vector>

namespace palpa::bem {

inline constexpr int kMaxSplineDegree = 5;

/// Basis functions of one knot span as polynomials in (t - lower) scale - 1, which runs from -1
/// to 1.
struct SpanPolynomials {
  int degree;
  double lower, scale;
  const double* coefficients;  ///< [power][function]
};

/// B-spline basis functions along one direction of a patch. Each function is stored as one
/// polynomial per knot span, because integrals over elements evaluate the functions millions of
/// times.
class BsplineBasis {
 public:
  /// Basis with the given `degree` (1 … 5) and `knots`: clamped, non-decreasing, inner multiplicity
  /// at most the degree, functions + degree + 1 in number. Throws std::invalid_argument if the
  /// degree or the number of knots is out of range, or if the knots do not increase.
  BsplineBasis(int degree, std::vector<double> knots);

  bool operator==(const BsplineBasis& other) const {
    return degree_ == other.degree_ && knots_ == other.knots_;
  }

  int degree() const { return degree_; }
  /// Number of functions.
  int count() const { return static_cast<int>(knots_.size()) - degree_ - 1; }
  const std::vector<double>& knots() const { return knots_; }

  /// Interval between two different knots. Functions first … first + degree are nonzero on it.
  struct Span {
    double lower, upper;
    int first;
  };
  const std::vector<Span>& spans() const { return spans_; }

  /// Greville abscissa: the mean of the inner knots of a function, the parameter where its
  /// coefficient has the most weight.
  double greville(int function) const;

  /// Values and first derivatives (degree + 1 each) of the functions of a span. The parameter may
  /// lie outside the span: the polynomials are extrapolated.
  void evaluate(int span, double parameter, double* values, double* derivatives) const;

  /// Polynomials of the functions of a span; valid during the lifetime of this basis.
  SpanPolynomials polynomials(int span) const;

 private:
  int degree_;
  std::vector<double> knots_;
  std::vector<Span> spans_;
  /// [span][power][function], in a variable that runs from -1 to 1 over the span.
  std::vector<double> polynomials_;
};

}  // namespace palpa::bem
