#pragma once

#include <vector>

#include "modeling/solid/solid.h"

// Knot insertion, knot removal and degree elevation on a solid. All functions act on one direction
// of a patch and on all patches that are glued to it side by side in that direction (around a
// cylinder, along a strip of a cube), so that the solid stays closed. Patch names and smooth edges
// are preserved; control points are renumbered. Cost: about a millisecond for a thousand control
// points.
namespace palpa::modeling {

inline constexpr int kMaxNetRows = 1000;  ///< of a patch in one direction, after an insertion

/// Direction of a patch: 0 is u, 1 is v.
struct PatchDirection {
  int patch = 0;
  int direction = 0;
};

/// Direction in the chain of another one; reversed if its parameter runs against the other's.
struct ChainLink {
  PatchDirection at;
  bool reversed = false;
};

/// Chain of the directions that share knots with `at` through glued sides; `at` is the first.
std::vector<ChainLink> chainOf(const Solid& solid, PatchDirection at);

/// Inserts a knot `times` times. The surface changes only by rounding. A parameter within 1e-9 of
/// the range from an existing knot denotes that knot. Throws ModelingError (message begins with
/// "at: " or "times: ") if the parameter is outside the inner range or closer than 1e-6 of the
/// range to another knot, if the knot would occur more often than the degree, or if a patch would
/// get more than kMaxNetRows rows.
Solid insertKnot(const Solid& solid, PatchDirection at, double parameter, int times = 1);

/// Inserts several new knots at once: the result of several insertKnot() calls in the time of one.
/// Throws ModelingError (message begins with "at: ") if a parameter is outside the inner range or
/// closer than 1e-6 of the range to a knot or to another parameter, or if a patch would get more
/// than kMaxNetRows rows.
Solid insertKnots(const Solid& solid, PatchDirection at, std::vector<double> parameters);

/// Result of removeKnot().
struct KnotRemoval {
  Solid solid;
  double deviation = 0.0;  ///< mm: largest sampled distance of points with equal parameters
};

/// Removes an inner knot `times` times. Distant control points keep their positions; edges and
/// vertices stay shared. Throws ModelingError (message begins with "at: ", "times: " or
/// "tolerance_mm: ") if there is no such knot, if it occurs less often than `times`, or if the
/// surface would move by more than the tolerance (mm).
KnotRemoval removeKnot(const Solid& solid, PatchDirection at, double parameter, int times,
                       double tolerance);

/// Raises the degree, up to 5. The surface changes only by rounding; the multiplicity of inner
/// knots rises equally, which keeps their continuity. Throws ModelingError (message begins with
/// "degree: ") if the degree is not higher than the present one, or is above 5.
Solid elevateDegree(const Solid& solid, PatchDirection at, int degree);

/// Largest distance (mm) of points with equal fractions of the parameter range, over all patches of
/// two solids with the same patches, by 6 × 6 samples per span of `a`.
double sampledDistance(const Solid& a, const Solid& b);

}  // namespace palpa::modeling
