#pragma once

#include <vector>

#include "modeling/solid/solid.h"

// Checks of the invariants of Solid, in the order in which they must run: each check relies on the
// previous ones. All throw ModelingError with a path as in the project file.
namespace palpa::modeling {

/// Throws ModelingError if a coordinate is not finite or exceeds ten kilometres.
void checkPoints(const std::vector<Eigen::Vector3d>& points);

/// Throws ModelingError if a control point, or a name, degree, net size, index or knot of a single
/// patch is invalid.
void checkPatches(const std::vector<Eigen::Vector3d>& points, const std::vector<Patch>& patches);

/// Control point indices along a side, in growing parameter.
std::vector<int> sideIndices(const Patch& patch, Side side);

/// Pairs the sides of all patches: equal points, degrees and knots, consistent orientation. Throws
/// ModelingError if a side has no unique partner.
std::vector<SolidEdge> glueSides(const std::vector<Patch>& patches);

/// Throws ModelingError if the patches around a vertex do not form a single fan (two cones that
/// meet at a point).
void checkVertexFans(const std::vector<Patch>& patches, const std::vector<SolidEdge>& edges);

/// Throws ModelingError if the normals do not point outwards (the enclosed volume is not positive).
void checkOutward(const std::vector<Eigen::Vector3d>& points, const std::vector<Patch>& patches);

}  // namespace palpa::modeling
