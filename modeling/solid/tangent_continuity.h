#pragma once

#include <vector>

#include "modeling/solid/solid.h"

// Smooth edges: edges along which the two patches keep a common tangent plane while control points
// are edited. The tangent planes depend only on the edge's row of control points and the next row
// of either patch; those are what is adjusted.
namespace palpa::modeling {

/// Largest angle in rad (0 … pi) between the tangent planes of the two patches of an edge, by 12
/// samples per span. Places where a patch has no normal (a corner in which its two derivatives are
/// parallel) are left out.
double tangentAngle(const Solid& solid, int edge);

/// The largest tangentAngle() of the smooth edges; 0 when there are none.
double largestTangentAngle(const Solid& solid);

/// Makes the smooth edges tangent-continuous again after some control points of `before` were moved
/// to give `after` (same topology). The points in `held` (ascending) stay where the user put them
/// as long as the others can follow (up to 0.02 rad, or twice the angle before); the others near
/// them, in the three rows beside the edge, move as little as possible. Edges and points that the
/// change does not reach keep their bits.
///
/// Exact (below 1e-6 rad) where the net allows it, for example between the quarters of a cylinder;
/// where three smooth edges meet in a corner the spline space allows only an approximation, and
/// tangentAngle() says how good it is. Cost: about a millisecond per edge concerned.
/// @throws ModelingError as Solid::withControlPoints
Solid restoreTangents(const Solid& before, const Solid& after, const std::vector<int>& held);

/// Makes the given edges (indices into edges()), which must be smooth ones, tangent-continuous from
/// any state, with the smooth edges that share control points with them.
Solid makeTangent(const Solid& solid, const std::vector<int>& edges);

}  // namespace palpa::modeling
