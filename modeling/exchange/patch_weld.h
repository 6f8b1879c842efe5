#pragma once

#include <gp_Pnt.hxx>
#include <vector>

#include "modeling/exchange/knot_chain.h"
#include "modeling/exchange/quad_faces.h"
#include "modeling/solid/solid.h"

// Internal to modeling/exchange/: only .cpp files include this header.
namespace palpa::modeling {

/// Control points net[i][j] of a patch (mm), i along u, j along v.
using Net = std::vector<std::vector<Eigen::Vector3d>>;

inline Eigen::Vector3d toEigen(const gp_Pnt& p) {
  return {p.X(), p.Y(), p.Z()};
}

/// A patch with separate control points, before they are joined with the points of its neighbours.
struct LoosePatch {
  Patch patch;  // without net
  Net net;      // empty for flat faces
};

/// Solid from loose patches, one per face: one control point per vertex, one row per edge. Flat
/// faces become Coons patches between their rows. `tolerance` (mm) is the largest distance between
/// the rows of two neighbours.
/// Throws NoPatches that names the faces that do not fit; ModelingError as the constructor of
/// Solid.
Solid weldPatches(const QuadFaces& quads, const KnotChains& chains, std::vector<LoosePatch> patches,
                  double tolerance);

}  // namespace palpa::modeling
