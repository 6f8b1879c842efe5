#pragma once

#include <span>

#include "base/job.h"
#include "modeling/body/body.h"
#include "modeling/mesh/mesh_settings.h"
#include "modeling/mesh/surface_mesh.h"

namespace palpa::modeling {

inline constexpr double kMaxNodes = 5e6;
/// Of a mesh body, relative, by meshing it.
inline constexpr double kMaxVolumeChange = 0.5;

/// Meshes the solid and fits the mesh to the borders of the regions. Deterministic: the same input
/// gives the same mesh to the last bit.
///
/// The number of pieces along each chain of glued edges follows from arc length / edgeLength, with
/// at least three for a quarter of a circle, closer where it bends; triangles of thin patches are
/// bisected until they are at most about five times as long as high; the border of a half space
/// or painting becomes a chain of mesh edges, so that each triangle lies on one side of it; with
/// refinement the size falls linearly towards sharp edges or borders.
///
/// Throws ModelingError if settings are out of range, patchFactors has an unknown patch, a region
/// (named) selects nothing or nothing wider than a quarter of the edge length, or more than
/// kMaxNodes nodes are needed (checked before anything is allocated). Throws Cancelled. Progress is
/// reported as phase "mesh".
SurfaceMesh mesh(const Solid& solid, const MeshSettings& settings,
                 std::span<const MeshRegion> regions = {}, const Job& job = {});

/// Triangulates the surface of a mesh body again, to the edge length. Nodes lie on the body's
/// triangles and have no parameters (the list is empty); they are in the order of a space filling
/// curve. Sharp edges (kSharpAngle), borders of faces and of regions become chains of mesh edges;
/// patches are the body's faces. Where features are closer than the edge length or turn within it,
/// edges are shorter. Cost: about 25 µs per triangle of the body and of the mesh.
/// Throws ModelingError also if the edge length is too coarse for the body: the volume would change
/// by more than kMaxVolumeChange.
SurfaceMesh mesh(const MeshBody& body, const MeshSettings& settings,
                 std::span<const MeshRegion> regions = {}, const Job& job = {});

SurfaceMesh mesh(const Body& body, const MeshSettings& settings,
                 std::span<const MeshRegion> regions = {}, const Job& job = {});

/// Approximate number of nodes that mesh() makes: within 5 % without refinement, about 40 % with it
/// or with strokes (overlaps count twice), a factor of about four where patches are so narrow that
/// cells have to be cut. Infinite for absurdly small edge lengths. Takes milliseconds and no memory
/// worth mentioning. Throws ModelingError as validate() and checkRegion().
double estimateNodeCount(const Solid& solid, const MeshSettings& settings,
                         std::span<const MeshRegion> regions = {});
double estimateNodeCount(const MeshBody& body, const MeshSettings& settings,
                         std::span<const MeshRegion> regions = {});
double estimateNodeCount(const Body& body, const MeshSettings& settings,
                         std::span<const MeshRegion> regions = {});

}  // namespace palpa::modeling
