#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/job.h"
#include "modeling/mesh/mesh_settings.h"
#include "modeling/mesh/surface_mesh.h"

// Meshes that follow the control points of their solid: same triangles, other positions.
namespace palpa::modeling {

/// How far a mesh may be distorted before it is to be made anew. Only triangles with a moved node
/// are judged.
struct FollowLimits {
  double smallestAngle = 12.0;    ///< degrees; a triangle below it must not be worse than it was
  double edgeRatio = 2.5;         ///< an edge may become longer or shorter by this factor
  double leastAlongNormal = 0.2;  ///< cosine between a triangle's normal and the surface's, > 0
};

struct MeshUpdate {
  SurfaceMesh mesh;             ///< the triangles, patches and regions of the mesh before
  std::vector<int> movedNodes;  ///< nodes whose position differs from before in any bit, ascending
};

/// Either an update or a sentence that says why the solid must be meshed anew.
struct FollowResult {
  std::optional<MeshUpdate> update;
  std::string remeshReason;  ///< empty with an update
};

/// Carries a mesh over to a solid with the same patches whose control points have moved.
///
/// Every node is evaluated at its parameters; a node on the border of a half space slides within
/// the surface (along its edge, if it lies on one) until it lies on the border again. Nodes that no
/// moved control point influences keep their exact bits.
///
/// `previous` is a mesh of `meshed`, made by mesh() with the same regions or by this function.
/// Following from the mesh that mesh() made, instead of from the last update, makes the result a
/// function of the solid alone: undoing a move gives the former mesh bit for bit.
///
/// Meshing anew is asked for when patches, knots or regions differ; when triangles exceed the
/// limits; when a part of the surface enters or leaves a half space other than by a shift of its
/// border; when an edge becomes sharp or stops being so (FollowResult::remeshReason says which).
///
/// Cost: about 3 µs per node on patches with moved control points. @throws Cancelled
FollowResult followSolid(const SurfaceMesh& previous, const Solid& meshed, const Solid& solid,
                         std::span<const MeshRegion> regions = {}, const FollowLimits& limits = {},
                         const Job& job = {});

/// Nodes whose positions differ in any bit between two meshes with equally many nodes, ascending.
/// @throws std::invalid_argument when the numbers of nodes differ
std::vector<int> differingNodes(const SurfaceMesh& a, const SurfaceMesh& b);

}  // namespace palpa::modeling
