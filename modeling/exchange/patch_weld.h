#pragma once

#include <gp_Pnt.hxx>
#include <vector>

#include "modeling/exchange/knot_chain.h"
#include "modeling/exchange/quad_faces.h"
#include "modeling/solid/solid.h"

// Internal to modeling/exchange/: only .cpp files include this header.
namespace palpa::modeling {

using Net = std::vector<std::vector<Eigen::Vector3d>>;

inline Eigen::Vector3d toEigen(const gp_Pnt& p) {
  return {p.X(), p.Y(), p.Z()};
}

/// A patch with control points of its own, before they are joined with those of its neighbours.
struct LoosePatch {
  Patch patch;  // without net
  Net net;      // empty for flat faces
};

/// Joins loose patches, one per face, to a solid: one control point per vertex, one row per edge.
/// Flat faces become Coons patches between their rows. `tolerance` in mm: how far the rows of two
/// neighbours may differ.
/// @throws NoPatches that says which faces do not fit; ModelingError as the constructor of Solid
Solid weldPatches(const QuadFaces& quads, const KnotChains& chains, std::vector<LoosePatch> patches,
                  double tolerance);

}  // namespace palpa::modeling
