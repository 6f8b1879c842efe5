#pragma once

#include "bench/peers/tetrahedra.h"

namespace palpa::bench::test {

/// Box from the origin, `cells` along each edge, six tetrahedra per cell; held (tag 1) where z = 0.
TetrahedralMesh boxOfTetrahedra(const Eigen::Vector3d& size, int cells);

/// The same cells of a cube drawn onto a ball around the origin, with all surface nodes on the
/// sphere; held where the cube's lowest face was.
TetrahedralMesh ballOfTetrahedra(double radius, int cells);

}  // namespace palpa::bench::test
