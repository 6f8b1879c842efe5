#pragma once

#include "modeling/exchange/drawing.h"

namespace palpa::modeling {

/// Spline of a drawing, rational if it has weights, in the coordinates of the file.
struct DrawnSpline {
  static constexpr int kMaxDegree = 15;
  static constexpr std::size_t kMaxPoints = 10'000;

  int degree = 3;             ///< 1 … kMaxDegree
  std::vector<double> knots;  ///< points + degree + 1, ascending; need not be clamped
  std::vector<Eigen::Vector2d> points;
  std::vector<double> weights;  ///< > 0; none, or one per point
};

/// Adds the curve as a path: exact up to degree 3 without different weights, otherwise within
/// kArcError of its size. Throws ModelingError (without a place) if the numbers do not make a
/// spline; Cancelled.
void addSpline(DrawingBuilder& builder, const DrawnSpline& spline, const Job& job);

}  // namespace palpa::modeling
