#pragma once

#include <vector>

#include "modeling/solid/solid.h"

// Smooth edges: edges along which the two patches keep a common tangent plane while control points
// are edited. The tangent planes depend only on the edge's row of control points and the adjacent
// row of either patch; these rows are adjusted.
namespace palpa::modeling {

/// Largest angle in rad (0 … pi) between the tangent planes of the two patches of an edge, by 12
/// samples per span. Samples where a patch has no normal (a corner with parallel derivatives) are
/// omitted.
double tangentAngle(const Solid& solid, int edge);

/// Largest tangentAngle() of the smooth edges, rad; 0 if there are none.
double largestTangentAngle(const Solid& solid);

/// Restores tangent continuity of the smooth edges after some control points of `before` were moved
/// to give `after` (same topology). The points in `held` (ascending) stay where the user put them
/// as long as the others can follow (up to 0.02 rad, or twice the previous angle). The other points
/// near them, in the three rows along the edge, move as little as possible. Edges and points that
/// the change does not affect keep their bits.
///
/// The result is exact (below 1e-6 rad) where the net allows it, for example between the quarters
/// of a cylinder. Where three smooth edges meet in a corner, the spline space allows only an
/// approximation; tangentAngle() returns its error. Takes about a millisecond per affected edge.
/// Throws ModelingError under the conditions of Solid::withControlPoints().
Solid restoreTangents(const Solid& before, const Solid& after, const std::vector<int>& held);

/// Makes the given edges (indices into edges(), all smooth), and the smooth edges that share
/// control points with them, tangent-continuous from any initial state.
Solid makeTangent(const Solid& solid, const std::vector<int>& edges);

}  // namespace palpa::modeling
