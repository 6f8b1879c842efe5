#pragma once

#include <vector>

#include "modeling/solid/solid.h"

namespace palpa::modeling {

/// For each given control point (none twice) the outward unit normal of the surface near it: at the
/// Greville abscissae of its place in the net, the mean of all patches that use it. Zero for a
/// point that no patch uses or where the mean vanishes.
std::vector<Eigen::Vector3d> controlNormals(const Solid& solid, const std::vector<int>& points);

}  // namespace palpa::modeling
