#pragma once

#include <vector>

#include "modeling/solid/solid.h"

namespace palpa::modeling {

/// Outward unit normals of the surface near the given control points, which must be distinct. A
/// normal is evaluated at the Greville abscissae of the point's position in the net, as the mean
/// over all patches that use the point. Zero for a point that no patch uses, or where the mean
/// vanishes.
std::vector<Eigen::Vector3d> controlNormals(const Solid& solid, const std::vector<int>& points);

}  // namespace palpa::modeling
