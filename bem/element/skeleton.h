#pragma once

#include <Eigen/Dense>
#include <span>

#include "bem/element/kelvin_sums.h"
#include "bem/linalg/cluster_tree.h"
#include "bem/linalg/row_choice.h"

namespace palpa::bem {

/// Row i of Kelvin's displacement kernel U at x by unit forces at y along 0, 1, 2, times a factor.
void setForce(const KelvinConstants& constants, const Eigen::Vector3d& x, const Eigen::Vector3d& y,
              int i, double factor, float* to);
/// Row i of Kelvin's traction kernel T(x, y) at a surface point y with normal n, times a factor.
void setDislocation(const KelvinConstants& constants, const Eigen::Vector3d& x,
                    const Eigen::Vector3d& y, const Eigen::Vector3d& n, int i, double factor,
                    float* to);

/// True if sources in a ball are distant from points in another one: their fields on the points are
/// fields of forces on a sphere around them, outside of which the sources are. `sources` may be the
/// larger ball.
bool isDistant(const Ball& points, const Ball& sources);

/// Chooses some of the rows from which the fields of all distant sources are interpolated at all
/// rows (the skeleton of a cluster; Cheng, Gimbutas, Martinsson and Rokhlin 2005). Row 3 k + i is
/// component i at point k. `ball`: about the points; its radius is positive. `tolerance`: relative
/// error of the interpolation, 1e-6 at least. Numbers in the result count within `rows`.
RowChoice chooseSkeleton(const KelvinConstants& constants, std::span<const Eigen::Vector3d> points,
                         std::span<const int> rows, const Ball& ball, double tolerance);

}  // namespace palpa::bem
