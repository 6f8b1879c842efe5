#pragma once

#include <vector>

#include "modeling/solid/solid.h"

// The checks behind the invariants of Solid, in the order in which they must run: each relies on
// those before it. All throw ModelingError with a path as in the project file.
namespace palpa::modeling {

/// Every coordinate is finite and within ten kilometres.
void checkPoints(const std::vector<Eigen::Vector3d>& points);

/// Control points, names, degrees, net sizes, indices and knots of each patch by itself.
void checkPatches(const std::vector<Eigen::Vector3d>& points, const std::vector<Patch>& patches);

/// Control point indices along a side, in growing parameter.
std::vector<int> sideIndices(const Patch& patch, Side side);

/// Pairs up the sides of all patches: equal points, degrees and knots, consistent orientation.
std::vector<SolidEdge> glueSides(const std::vector<Patch>& patches);

/// Around every vertex the patches must form a single fan (no two cones meeting at a point).
void checkVertexFans(const std::vector<Patch>& patches, const std::vector<SolidEdge>& edges);

/// The normals must point outwards: the enclosed volume is positive.
void checkOutward(const std::vector<Eigen::Vector3d>& points, const std::vector<Patch>& patches);

}  // namespace palpa::modeling
