#pragma once

#include <span>

#include "base/job.h"
#include "modeling/body/body.h"
#include "modeling/mesh/mesh_focus.h"
#include "modeling/mesh/mesh_settings.h"
#include "modeling/mesh/surface_mesh.h"

namespace palpa::modeling {

inline constexpr double kMaxNodes = 5e6;
/// Largest relative change of the volume of a mesh body by meshing.
inline constexpr double kMaxVolumeChange = 0.5;

/// Mesh of a solid, fitted to the borders of the regions. Deterministic: the same input gives the
/// same mesh to the last bit.
///
/// The number of pieces along each chain of glued edges is arc length / edgeLength, but at least
/// three per quarter of a circle; pieces are shorter where the edge bends. Triangles of thin
/// patches are bisected until their length is at most about five times their height. The border of
/// a half space or painting becomes a chain of mesh edges, so that each triangle lies on one side
/// of it. With refinement the edge length falls linearly towards sharp edges or borders.
///
/// Around foci the edge length falls likewise, if it is not shorter anyway.
///
/// Throws ModelingError if settings are out of range, patchFactors has an unknown patch, a region
/// (the message names it) selects nothing or nothing wider than a quarter of the edge length, or
/// more than kMaxNodes nodes are needed (checked before allocation). Throws Cancelled. Progress has
/// the phase "mesh".
SurfaceMesh mesh(const Solid& solid, const MeshSettings& settings,
                 std::span<const MeshRegion> regions = {}, const Job& job = {},
                 std::span<const MeshFocus> foci = {});

/// New triangulation of the surface of a mesh body with the given edge length. Nodes lie on the
/// body's triangles, have no parameters (the list is empty) and follow a space filling curve. Sharp
/// edges (kSharpAngle) and the borders of faces and regions become chains of mesh edges; patches
/// are the body's faces. Edges are shorter where features are closer together than the edge length
/// or turn within it. Cost: about 25 µs per triangle of the body and of the mesh. Throws
/// ModelingError also if the edge length is too coarse for the body: the volume would change by
/// more than kMaxVolumeChange.
SurfaceMesh mesh(const MeshBody& body, const MeshSettings& settings,
                 std::span<const MeshRegion> regions = {}, const Job& job = {},
                 std::span<const MeshFocus> foci = {});

/// Mesh of either kind of body for the engine of the settings: quadraticMesh() of a mesh with twice
/// the edge length for quadratic triangles.
SurfaceMesh mesh(const Body& body, const MeshSettings& settings,
                 std::span<const MeshRegion> regions = {}, const Job& job = {},
                 std::span<const MeshFocus> foci = {});

/// Approximate number of nodes of mesh(). Error: 5 % without refinement, about 40 % with refinement
/// or strokes (overlaps count twice), a factor of about four if patches are so narrow that cells
/// must be cut. Infinite for absurdly small edge lengths. Cost: milliseconds, negligible memory;
/// for mesh bodies a simplified surface is made, which takes many seconds for 200,000 triangles.
/// Throws ModelingError as validate() and checkRegion(); Cancelled.
double estimateNodeCount(const Solid& solid, const MeshSettings& settings,
                         std::span<const MeshRegion> regions = {},
                         std::span<const MeshFocus> foci = {});
double estimateNodeCount(const MeshBody& body, const MeshSettings& settings,
                         std::span<const MeshRegion> regions = {},
                         std::span<const MeshFocus> foci = {}, const Job& job = {});
/// The same for the engine of the settings. Foci that overlap count several times.
double estimateNodeCount(const Body& body, const MeshSettings& settings,
                         std::span<const MeshRegion> regions = {},
                         std::span<const MeshFocus> foci = {}, const Job& job = {});

}  // namespace palpa::modeling
