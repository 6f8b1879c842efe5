#pragma once

#include "bem/model/boundary_mesh.h"

namespace palpa::bem {

/// Point of the triangulated surface.
struct SurfacePoint {
  int triangle;
  Eigen::Vector3d weights;   ///< barycentric coordinates
  Eigen::Vector3d position;  ///< mm
  double distance;           ///< mm, from the requested point
};

/// The point of one triangle nearest to `point`.
SurfacePoint nearestOnTriangle(const BoundaryMesh& mesh, int triangle,
                               const Eigen::Vector3d& point);

/// The surface point nearest to `point`. Looks at every triangle.
SurfacePoint nearestSurfacePoint(const BoundaryMesh& mesh, const Eigen::Vector3d& point);

/// Index of the node nearest to `point`.
int nearestNode(const BoundaryMesh& mesh, const Eigen::Vector3d& point);

}  // namespace palpa::bem
