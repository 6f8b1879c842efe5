#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/job.h"
#include "modeling/body/body.h"
#include "modeling/mesh/surface_mesh.h"

// Checks that a surface is the boundary of a body. They run after every edit, before a computation
// on the mesh.
namespace palpa::modeling {

/// Kinds of faults of a surface mesh.
enum class GeometryFault {
  kSelfIntersection,  ///< parts of the surface pass through each other or lie folded on each other
  kTouching,          ///< parts that are not neighbours touch without crossing: a warning
  kInvertedTriangle,  ///< a triangle's normal is opposite to the normal of the spline surface
  kZeroArea,          ///< a triangle has no area (its height is below 1e-8 of its longest edge)
  kOpenEdge,          ///< an edge has only one triangle
  kWrongOrientation,  ///< an edge is used twice in one direction
  kInsideOut,         ///< the enclosed volume is not positive
  kFoldedPatch,       ///< du × dv changes sign inside a patch or vanishes on a part of it
};

/// Name of a fault in JSON: "self_intersection", …
std::string_view faultName(GeometryFault fault);

/// A fault with its place.
struct GeometryFinding {
  GeometryFault fault{};
  bool isError = true;               ///< false: a warning
  std::vector<int> triangles;        ///< of the mesh, ascending; none for kInsideOut, kFoldedPatch
  std::vector<std::string> patches;  ///< names, in patch order
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< a point of the fault, mm
  std::string message;                           ///< a sentence for the user with all of the above
};

/// All faults of a mesh of the body, errors first. Connected triangles with the same fault make one
/// finding. A good solid has none: every reported fault exists, up to the flatness of the mesh
/// between its nodes. (Intersections of parts that are closer than the deviation of the mesh from
/// the surface may be missed or reported in error.)
///
/// `mesh` must have the patches and nodes of the body. Normals are compared only if the mesh has
/// parameters (mesh bodies have no spline surface); the volume is checked only if the mesh is
/// closed.
///
/// Cost: about 10 µs per triangle. Throws Cancelled.
std::vector<GeometryFinding> checkGeometry(const SurfaceMesh& mesh, const Body& body,
                                           const Job& job = {});

}  // namespace palpa::modeling
