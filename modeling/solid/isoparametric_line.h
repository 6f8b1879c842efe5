#pragma once

#include <Eigen/Core>
#include <vector>

#include "modeling/solid/knot_operations.h"
#include "modeling/solid/solid.h"

// Lines of constant parameter on a solid: what a knot looks like.
namespace palpa::modeling {

/// The point of a patch at (u, v), mm. Parameters outside the range are moved to its end.
Eigen::Vector3d surfacePoint(const Solid& solid, int patch, double u, double v);

/// The line of a patch where the parameter of `at.direction` has the given value and the other one
/// grows; `piecesPerSpan` pieces for each of its polynomial spans. mm.
std::vector<Eigen::Vector3d> isoparametricLine(const Solid& solid, PatchDirection at,
                                               double parameter, int piecesPerSpan = 12);

/// The lines that a knot of one direction makes on all patches it is shared with (chainOf), that of
/// `at` first.
std::vector<std::vector<Eigen::Vector3d>> knotLinesOf(const Solid& solid, PatchDirection at,
                                                      double parameter);

/// The distinct knots inside the range of a direction.
std::vector<double> innerKnots(const Solid& solid, PatchDirection at);

}  // namespace palpa::modeling
