#pragma once

#include <Eigen/Dense>
#include <vector>

#include "bem/model/boundary_mesh.h"

namespace palpa::bem {

/// Where the boundary integral equation is demanded to hold. Each point lies in (or at a corner of)
/// a host triangle; its barycentric weights say which displacement coefficients make up u(x), which
/// is all that the free term needs.
struct CollocationPoint {
  Eigen::Vector3d position;  ///< mm
  int triangle;              ///< a triangle that contains the point
  Eigen::Vector3d weights;   ///< its barycentric coordinates there; a unit vector for a node
};

/// One point per node, in node order.
std::vector<CollocationPoint> nodalCollocation(const BoundaryMesh& mesh);

/// A point inside the triangle of `slot` that lies most squarely in the slot's face, moved from the
/// slot's node by `shift` (in (0, 1)) of the way to the opposite edge. Such points supply the
/// equations for the second and third traction of a node where faces with prescribed displacement
/// meet in a sharp edge.
CollocationPoint shiftedCollocation(const BoundaryMesh& mesh, const TractionSlots& slots, int slot,
                                    double shift = 0.4);

}  // namespace palpa::bem
