#pragma once

#include <array>
#include <vector>

namespace palpa::modeling {

inline constexpr int kMaxDegree = 5;  ///< of a patch, in each direction

/// B-spline basis functions that are nonzero at a parameter, with their first derivatives:
/// functions first … first + degree.
struct BasisFunctions {
  int first = 0;
  std::array<double, kMaxDegree + 1> value{};
  std::array<double, kMaxDegree + 1> derivative{};
};

/// Basis functions at a parameter for clamped knots. The upper end of the knot range belongs to the
/// last span. Throws std::invalid_argument if the parameter is outside the knots.
BasisFunctions basisAt(const std::vector<double>& knots, int degree, double parameter);

/// Greville abscissa: the mean of the degree inner knots of control point `index`, approximately
/// the parameter at which the point has the most weight.
double greville(const std::vector<double>& knots, int degree, int index);

}  // namespace palpa::modeling
