#include "modeling/shapes/sketch_knots.h"

#include <algorithm>
#include <cmath>

#include "modeling/shapes/opencascade_curve.h"

namespace palpa::modeling {

std::size_t knotsNeeded(int innerPoints, int degree) {
  return static_cast<std::size_t>(std::max(0, innerPoints + 1 - degree));
}

std::vector<double> uniformKnots(std::size_t count) {
  std::vector<double> knots;
  for (std::size_t i = 1; i <= count; ++i)
    knots.push_back(static_cast<double>(i) / static_cast<double>(count + 1));
  return knots;
}

bool isUniform(const std::vector<double>& knots) {
  const double spans = static_cast<double>(knots.size()) + 1.0;
  for (std::size_t i = 0; i < knots.size(); ++i)
    if (std::abs(knots[i] - static_cast<double>(i + 1) / spans) > 1e-9) return false;
  return true;
}

void fillTo(std::vector<double>& knots, std::size_t count) {
  while (knots.size() < count) {
    double low = 0.0, best = 0.0, width = -1.0;
    for (std::size_t i = 0; i <= knots.size(); ++i) {
      const double high = i < knots.size() ? knots[i] : 1.0;
      if (high - low > width * (1.0 + 1e-9)) {
        width = high - low;
        best = 0.5 * (low + high);
      }
      low = high;
    }
    knots.insert(std::upper_bound(knots.begin(), knots.end(), best), best);
  }
}

void thinTo(std::vector<double>& knots, std::size_t count, double near) {
  while (knots.size() > count)
    knots.erase(std::min_element(knots.begin(), knots.end(), [&](double a, double b) {
      return std::abs(a - near) < std::abs(b - near);
    }));
}

void insertKnot(SplineBasis& basis, std::vector<Eigen::Vector2d>& points, double u) {
  ProfileCurve curve;
  curve.degree = basis.degree;
  curve.points = points;
  curve.knots = basis.knots;
  const Handle(Geom2d_BSplineCurve) refined = makeCurve(curve);
  refined->InsertKnot(u, 1, 0.0);
  curve = toProfileCurve(*refined);
  points = std::move(curve.points);
  basis.knots = std::move(curve.knots);
}

}  // namespace palpa::modeling
