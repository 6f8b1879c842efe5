#pragma once

#include <Eigen/Dense>
#include <vector>

#include "bem/model/boundary_mesh.h"

namespace palpa::bem {

/// Point at which the boundary integral equation is satisfied. It lies in a host triangle or at a
/// corner of it; the barycentric weights of the displacement coefficients give u(x) for the free
/// term.
struct CollocationPoint {
  Eigen::Vector3d position;  ///< mm
  int triangle;              ///< a triangle that contains the point
  Eigen::Vector3d weights;   ///< its barycentric coordinates there; a unit vector for a node
};

/// One point per node, in node order.
std::vector<CollocationPoint> nodalCollocation(const BoundaryMesh& mesh);

/// A point inside the triangle of `slot` with the widest corner at the slot's node, moved from the
/// node towards the opposite edge by the fraction `shift`, in (0, 1). Such points supply the
/// equations for the second and third traction of a node where faces with prescribed displacement
/// meet in a sharp edge.
CollocationPoint shiftedCollocation(const BoundaryMesh& mesh, const TractionSlots& slots, int slot,
                                    double shift = 0.4);

}  // namespace palpa::bem
