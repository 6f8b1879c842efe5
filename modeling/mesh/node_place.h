#pragma once

#include <array>
#include <vector>

#include "modeling/solid/edge_curve.h"
#include "modeling/solid/surface_evaluator.h"

namespace palpa::modeling {

/// What a point of the surface lies on: the inside of a patch, an edge or a corner of the solid,
/// with its names in all patches that meet there.
struct NodePlace {
  std::vector<SurfaceParameter> at;  ///< the first is the name that was asked about
  int edge = -1;                     ///< index into Solid::edges() when on one; -1 in a corner
  double edgeFraction = 0.0;         ///< 0 … 1 of the parameter of the edge's uses[0]
  int vertex = -1;                   ///< control point, when in a corner

  bool isInside() const { return edge < 0 && vertex < 0; }
};

/// Edges and corners are recognised by parameters exactly at the ends of the patch's ranges, which
/// is how mesh() names its nodes.
NodePlace placeOf(const Solid& solid, const SurfaceEvaluator& surface, const SurfaceParameter& at);

/// Names in one patch of the corners of a triangle in it. A patch that is glued to itself gives a
/// point two names: those are taken that make the triangle small.
std::array<SurfaceParameter, 3> cornersIn(const SurfaceEvaluator& surface, int patch,
                                          const std::array<const NodePlace*, 3>& corners);

}  // namespace palpa::modeling
