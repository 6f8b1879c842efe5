#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/job.h"
#include "modeling/body/body.h"
#include "modeling/mesh/surface_mesh.h"

// Is the surface the boundary of a body? What is asked after every edit, before anything is
// computed on the mesh.
namespace palpa::modeling {

enum class GeometryFault {
  kSelfIntersection,  ///< parts of the surface pass through each other or lie folded on each other
  kTouching,          ///< parts that are no neighbours touch without passing through: a warning
  kInvertedTriangle,  ///< a triangle's normal points against that of the spline surface
  kZeroArea,          ///< a triangle has no area (its height is below 1e-8 of its longest edge)
  kOpenEdge,          ///< an edge has only one triangle
  kWrongOrientation,  ///< an edge is used twice in one direction
  kInsideOut,         ///< the enclosed volume is not positive
  kFoldedPatch,       ///< du × dv turns over inside a patch, or vanishes on a part of it
};

/// The fault's name in JSON: "self_intersection", …
std::string_view faultName(GeometryFault fault);

struct GeometryFinding {
  GeometryFault fault{};
  bool isError = true;               ///< false: a warning
  std::vector<int> triangles;        ///< of the mesh, ascending; empty for insideOut, foldedPatch
  std::vector<std::string> patches;  ///< names, in patch order
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< a point of the fault, mm
  std::string message;                           ///< a sentence for people that says all this
};

/// All faults of a mesh of the body, errors first. Connected triangles with the same fault make one
/// finding. Good solids have none: what is reported is there, up to the mesh being flat between its
/// nodes (parts closer to each other than that may be reported as, or hide, an intersection).
///
/// `mesh` must have patches and nodes of the body; without parameters (mesh bodies) there is no
/// spline surface to compare normals with. An open surface is not asked for its volume.
///
/// Cost: about 10 µs per triangle. @throws Cancelled
std::vector<GeometryFinding> checkGeometry(const SurfaceMesh& mesh, const Body& body,
                                           const Job& job = {});

}  // namespace palpa::modeling
