#pragma once

#include <vector>

#include "modeling/solid/solid.h"

// Knot insertion, knot removal and degree elevation on a solid. All act on one direction of a patch
// and on all patches that are glued to it side by side in that direction (around a cylinder, along
// a strip of a cube), so that the solid stays closed. Patch names and smooth edges survive; control
// points are numbered anew. Cost: about a millisecond for a thousand control points.
namespace palpa::modeling {

inline constexpr int kMaxNetRows = 1000;  ///< of a patch in one direction after an insertion

/// A direction of a patch: 0 is u, 1 is v.
struct PatchDirection {
  int patch = 0;
  int direction = 0;
};

/// A direction in the chain of another; reversed when its parameter runs against the other's.
struct ChainLink {
  PatchDirection at;
  bool reversed = false;
};

/// The directions that share knots with one direction through glued sides, itself first.
std::vector<ChainLink> chainOf(const Solid& solid, PatchDirection at);

/// Inserts a knot `times` times. The surface stays the same up to rounding. A parameter within 1e-9
/// of the range of an existing knot means that knot.
/// @throws ModelingError that begins with "at: " or "times: ": outside the inner range; closer than
///         1e-6 of the range to another knot; repeated more often than the degree; too many rows
Solid insertKnot(const Solid& solid, PatchDirection at, double parameter, int times = 1);

/// Inserts several knots at once, each where no knot is yet: as many insertKnot() would, in the
/// time of one.
/// @throws ModelingError that begins with "at: ": outside the inner range; closer than 1e-6 of the
///         range to a knot or to each other; too many rows
Solid insertKnots(const Solid& solid, PatchDirection at, std::vector<double> parameters);

struct KnotRemoval {
  Solid solid;
  double deviation = 0.0;  ///< mm: largest distance of points with equal parameters, by sampling
};

/// Removes an inner knot `times` times. Far control points stay as they are; edges and vertices
/// remain common.
/// @throws ModelingError that begins with "at: ", "times: " or "tolerance_mm: ": there is no such
///         knot; it occurs less often; the surface would move by more than the tolerance (mm)
KnotRemoval removeKnot(const Solid& solid, PatchDirection at, double parameter, int times,
                       double tolerance);

/// Raises the degree, up to 5. The surface stays the same up to rounding; inner knots occur as many
/// times more, which keeps their continuity.
/// @throws ModelingError that begins with "degree: " when it is not higher than before or above 5
Solid elevateDegree(const Solid& solid, PatchDirection at, int degree);

/// Largest distance in mm of points with equal fractions of the parameter range, over all patches
/// of two solids with the same patches; by 6 × 6 samples per span of `a`.
double sampledDistance(const Solid& a, const Solid& b);

}  // namespace palpa::modeling
