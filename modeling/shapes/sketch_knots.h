#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "modeling/shapes/spline_basis.h"

// Knots of the runs of a ProfileSketch: ascending, in (0, 1). Internal to modeling/shapes.
namespace palpa::modeling {

/// Number of inner knots of a clamped spline with so many points between its ends; 0 for a Bézier
/// curve of lower degree.
std::size_t knotsNeeded(int innerPoints, int degree);

/// Knots that divide (0, 1) into count + 1 equal spans.
std::vector<double> uniformKnots(std::size_t count);

/// True if all spans have the same length, up to 1e-9.
bool isUniform(const std::vector<double>& knots);

/// Inserts knots in the middle of the widest spans until there are `count`.
void fillTo(std::vector<double>& knots, std::size_t count);

/// Removes one of the knots nearest to a parameter until there are `count`.
void thinTo(std::vector<double>& knots, std::size_t count, double near);

/// Inserts a knot u in (0, 1), not one of the basis; the curve stays the same. The degree is at
/// least 1, and there are basis.count() points.
void insertKnot(SplineBasis& basis, std::vector<Eigen::Vector2d>& points, double u);

}  // namespace palpa::modeling
