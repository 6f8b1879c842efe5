#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

// Spline spaces of one parameter over [0, 1], and interpolation in the product of two such spaces.
namespace palpa::modeling {

/// Spline basis: degree and clamped knots from 0 to 1.
struct SplineBasis {
  int degree = 3;
  std::vector<double> knots;

  int count() const { return static_cast<int>(knots.size()) - degree - 1; }
  int spanCount() const;
};

/// Basis with equal spans for `count` > degree control points.
SplineBasis uniformBasis(int degree, int count);

/// Basis with spans that shrink by a constant ratio towards 0, where a surface has an apex.
SplineBasis gradedBasis(int degree, int count, double ratio);

/// Basis of the same functions with reversed parameter.
SplineBasis reversed(const SplineBasis& basis);

/// Smallest basis that contains both: each inner knot with the larger of its multiplicities. Knots
/// closer than 1e-9 count as equal. Both bases must have the same degree.
SplineBasis merged(const SplineBasis& a, const SplineBasis& b);

/// Basis refined by halving the widest span (the first of equal ones) until there are `count`
/// control points.
SplineBasis refined(SplineBasis basis, int count);

/// Values of all basis functions at t. Throws ModelingError if OpenCASCADE cannot evaluate them.
Eigen::RowVectorXd basisValues(const SplineBasis& basis, double t);

using PointGrid = std::vector<std::vector<Eigen::Vector3d>>;

/// Control points [i along u][j along v] of the surface that equals point(s, t), s and t in [0, 1],
/// at the Greville abscissae (the knot averages, where spline interpolation is well conditioned).
/// Exact if the surface belongs to the space. A border row of the net depends only on points on
/// that border, so neighbours agree. Throws ModelingError if the interpolation fails.
PointGrid interpolate(const SplineBasis& u, const SplineBasis& v,
                      const std::function<Eigen::Vector3d(double, double)>& point);

}  // namespace palpa::modeling
