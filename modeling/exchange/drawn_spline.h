#pragma once

#include "modeling/exchange/drawing.h"

namespace palpa::modeling {

/// Spline of a drawing, rational if it has weights.
struct DrawnSpline {
  static constexpr int kMaxDegree = 15;
  static constexpr std::size_t kMaxPoints = 10'000;

  int degree = 3;
  std::vector<double> knots;
  std::vector<Eigen::Vector2d> points;
  std::vector<double> weights;  ///< none, or one per point
};

/// Adds the curve as a path: exact up to degree 3 without different weights, otherwise within
/// kArcError of its size. Throws ModelingError (without a place) if the numbers do not make a
/// spline; Cancelled.
void addSpline(DrawingBuilder& builder, const DrawnSpline& spline, const Job& job);

}  // namespace palpa::modeling
