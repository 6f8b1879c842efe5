#pragma once

#include <Eigen/Core>
#include <vector>

#include "modeling/solid/knot_operations.h"
#include "modeling/solid/solid.h"

// Lines of constant parameter on a solid, used to show knots.
namespace palpa::modeling {

/// Point of a patch at (u, v), mm. Parameters outside the range are clamped.
Eigen::Vector3d surfacePoint(const Solid& solid, int patch, double u, double v);

/// Line of a patch along which the parameter of `at.direction` has the given value and the other
/// parameter grows: `piecesPerSpan` pieces per polynomial span; points in mm.
std::vector<Eigen::Vector3d> isoparametricLine(const Solid& solid, PatchDirection at,
                                               double parameter, int piecesPerSpan = 12);

/// Lines that a knot of one direction makes on all patches that share it (chainOf); the line on the
/// patch of `at` is the first.
std::vector<std::vector<Eigen::Vector3d>> knotLinesOf(const Solid& solid, PatchDirection at,
                                                      double parameter);

/// Distinct knots strictly inside the range of a direction.
std::vector<double> innerKnots(const Solid& solid, PatchDirection at);

}  // namespace palpa::modeling
