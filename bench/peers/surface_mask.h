#pragma once

#include <vector>

#include "bench/peers/tetrahedra.h"

namespace palpa::bench {

/// The bump (1 - (ρ/radius)^2)^2 of a contact's mask (bem/contact/contact_mask.h) around a point, ρ
/// the distance from it, integrated against the functions of the surface's nodes: nodal forces of a
/// unit force, and the weights of the conjugate displacement.
struct SurfaceMask {
  std::vector<int> nodes;       ///< of the mesh, ascending
  std::vector<double> weights;  ///< sum to 1
};

SurfaceMask makeSurfaceMask(const TetrahedralMesh& mesh, const Eigen::Vector3d& at, double radius);

}  // namespace palpa::bench
