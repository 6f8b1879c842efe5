#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/job.h"
#include "modeling/mesh/mesh_settings.h"
#include "modeling/mesh/surface_mesh.h"

// Meshes that follow the control points of their solid: same triangles, new positions.
namespace palpa::modeling {

/// Largest distortion of a mesh before the solid must be meshed again. Limits apply to triangles
/// with a moved node.
struct FollowLimits {
  double smallestAngle = 12.0;    ///< degrees; a smaller angle must not fall further
  double edgeRatio = 2.5;         ///< largest factor by which an edge may grow or shrink
  double leastAlongNormal = 0.2;  ///< cosine between the normals of triangle and surface, > 0
};

/// A mesh after a change of its solid.
struct MeshUpdate {
  SurfaceMesh mesh;             ///< triangles, patches and regions of the previous mesh
  std::vector<int> movedNodes;  ///< nodes whose position differs in any bit, ascending
};

/// Either an update or the reason why the solid must be meshed again, as a sentence.
struct FollowResult {
  std::optional<MeshUpdate> update;
  std::string remeshReason;  ///< empty with an update
};

/// Incremental update of a mesh: carries it over to a solid with the same patches whose control
/// points have moved.
///
/// Every node is evaluated at its parameters. A node on the border of a half space slides within
/// the surface (along its edge if it lies on one) until it lies on the border again. Nodes without
/// influence of a moved control point keep their bits.
///
/// `previous` is a mesh of `meshed`, made by mesh() with the same regions or by this function.
/// If `previous` is always the result of mesh() instead of the last update, the result depends on
/// the solid alone: undoing a move gives the former mesh bit for bit.
///
/// The result requests a new mesh (with FollowResult::remeshReason) if patches, knots or regions
/// differ; if triangles exceed the limits; if a part of the surface enters or leaves a half space
/// other than by a shift of its border; or if an edge becomes sharp or ceases to be sharp.
///
/// Cost: about 3 µs per node on patches with moved control points. Throws Cancelled.
FollowResult followSolid(const SurfaceMesh& previous, const Solid& meshed, const Solid& solid,
                         std::span<const MeshRegion> regions = {}, const FollowLimits& limits = {},
                         const Job& job = {});

/// Nodes whose positions differ in any bit between two meshes with equally many nodes, ascending.
/// Throws std::invalid_argument if the numbers of nodes differ.
std::vector<int> differingNodes(const SurfaceMesh& a, const SurfaceMesh& b);

}  // namespace palpa::modeling
