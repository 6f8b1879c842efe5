#pragma once

#include <vector>

#include "app/verification/exact/solved_body.h"

/// Convergence for the field of a point force outside the body: it is smooth and not a polynomial.
namespace palpa::bem::test {

struct ConvergenceStep {
  int nodes;
  double displacementError, tractionError;
  double order;  ///< of the displacement error relative to the previous step; 0 for the first
};

/// Sphere of radius 25 mm, exact displacement below z = -10 mm, exact tractions elsewhere; source
/// 15 mm above the top, off the axis. `cells`: numbers along each cube edge.
std::vector<ConvergenceStep> sphereConvergence(double poissonRatio, const std::vector<int>& cells);

/// Cylinder of radius 20 and height 60 mm, exact displacement on the base, or on base and top,
/// exact tractions elsewhere; source 15 mm beside the lateral surface. `around`: numbers of cells
/// around; half as many along the axis.
std::vector<ConvergenceStep> cylinderConvergence(double poissonRatio,
                                                 const std::vector<int>& around, bool topFixed);

}  // namespace palpa::bem::test
