#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

// Spline spaces of one parameter over [0, 1], and interpolation in the product of two of them.
namespace palpa::modeling {

/// Degree and clamped knots from 0 to 1.
struct SplineBasis {
  int degree = 3;
  std::vector<double> knots;

  int count() const { return static_cast<int>(knots.size()) - degree - 1; }
  int spanCount() const;
};

/// Equal spans for `count` > degree control points.
SplineBasis uniformBasis(int degree, int count);

/// Spans that shrink by the same ratio towards 0, where a surface has an apex.
SplineBasis gradedBasis(int degree, int count, double ratio);

/// The basis of the same functions with the parameter running backwards.
SplineBasis reversed(const SplineBasis& basis);

/// The smallest basis that contains both: each inner knot as often as the one that has it more
/// often. Knots closer than 1e-9 count as equal. Both must have the same degree.
SplineBasis merged(const SplineBasis& a, const SplineBasis& b);

/// Halves the widest span, the first of equal ones, until there are `count` control points.
SplineBasis refined(SplineBasis basis, int count);

/// The values of all basis functions at t.
Eigen::RowVectorXd basisValues(const SplineBasis& basis, double t);

using PointGrid = std::vector<std::vector<Eigen::Vector3d>>;

/// Control points [i along u][j along v] of the surface that agrees with point(s, t), s and t in
/// [0, 1], at the Greville abscissae (the knot averages, where spline interpolation is well
/// conditioned). Exact when the surface belongs to the space. A row of the net on the border
/// depends only on points on that border, so neighbours agree.
PointGrid interpolate(const SplineBasis& u, const SplineBasis& v,
                      const std::function<Eigen::Vector3d(double, double)>& point);

}  // namespace palpa::modeling
