#pragma once

#include <Eigen/Core>

#include "bem/spline/bspline_basis.h"

namespace palpa::bem {

/// Weights of the functions first … first + order that give the coefficient of `function` for every
/// polynomial of the order, at most the degree of the basis: the extrapolation of extended
/// B-splines (Höllig 2003) along one parameter. They sum to 1.
Eigen::VectorXd extrapolationWeights(const BsplineBasis& basis, int first, int order, int function);

}  // namespace palpa::bem
