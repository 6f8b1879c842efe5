#pragma once

#include <array>
#include <vector>

namespace palpa::modeling {

inline constexpr int kMaxDegree = 5;  ///< of a patch, in each direction

/// The B-spline basis functions that are not zero at a parameter, with their first derivatives:
/// functions first … first + degree.
struct BasisFunctions {
  int first = 0;
  std::array<double, kMaxDegree + 1> value{};
  std::array<double, kMaxDegree + 1> derivative{};
};

/// For clamped knots and a parameter in their range (its end belongs to the last span).
BasisFunctions basisAt(const std::vector<double>& knots, int degree, double parameter);

/// Parameter at which control point `index` weighs most, nearly: the mean of its degree inner knots
/// (Greville abscissa).
double greville(const std::vector<double>& knots, int degree, int index);

}  // namespace palpa::modeling
