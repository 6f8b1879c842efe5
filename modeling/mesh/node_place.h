#pragma once

#include <array>
#include <vector>

#include "modeling/solid/edge_curve.h"
#include "modeling/solid/surface_evaluator.h"

namespace palpa::modeling {

/// Location of a surface point in the topology of a solid (inside a patch, on an edge or in a
/// corner), with its parameters in all patches that meet there.
struct NodePlace {
  std::vector<SurfaceParameter> at;  ///< the first is the argument of placeOf()
  int edge = -1;                     ///< index into Solid::edges() on an edge; -1 in a corner
  double edgeFraction = 0.0;         ///< 0 … 1 of the parameter of the edge's uses[0]
  int vertex = -1;                   ///< control point in a corner, otherwise -1

  bool isInside() const { return edge < 0 && vertex < 0; }
};

/// Location of the point with these parameters. A point counts as on an edge or in a corner only if
/// its parameters equal the ends of the patch's ranges exactly, as for the nodes of mesh().
NodePlace placeOf(const Solid& solid, const SurfaceEvaluator& surface, const SurfaceParameter& at);

/// Parameters in one patch of the corners of a triangle in this patch. If the patch is glued to
/// itself, a point has two parameter pairs there; the pairs of the smallest triangle are used.
std::array<SurfaceParameter, 3> cornersIn(const SurfaceEvaluator& surface, int patch,
                                          const std::array<const NodePlace*, 3>& corners);

}  // namespace palpa::modeling
