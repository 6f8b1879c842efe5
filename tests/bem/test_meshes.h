#pragma once
#include <functional>

#include "bem/boundary_mesh.h"

/// Boundary meshes of simple bodies for the tests of bem/, which must not depend on the modeller.
/// All nodes lie on the true surface; edge counts are the refinement parameter.
namespace palpa::bem::test {

/// Cube sphere of radius `radius` about the origin, `n` cells along each of the 12 cube edges (6
/// n^2 + 2 nodes).
BoundaryMesh sphereMesh(double radius, int n);

/// Thick shell: outer sphere and inner sphere oriented towards the centre.
BoundaryMesh hollowSphereMesh(double inner, double outer, int nInner, int nOuter);

/// Box with corners `low` and `high`; one smoothing group and tag per face in the order xmin, xmax,
/// ymin, ymax, zmin, zmax (tags 0 … 5).
BoundaryMesh boxMesh(const Eigen::Vector3d& low, const Eigen::Vector3d& high, int nx, int ny,
                     int nz);

/// Cylinder about the z axis, base at z = 0: `around` cells around, `up` along, `radial` rings on
/// the caps. Groups and tags: 0 side, 1 bottom, 2 top.
BoundaryMesh cylinderMesh(double radius, double height, int around, int up);

/// The same cylinder with cells that become small towards its edges (at the edges about a quarter
/// of their mean), for supports that make the stress singular there.
BoundaryMesh gradedCylinderMesh(double radius, double height, int around, int up);

/// Tube; groups and tags: 0 outer side, 1 bottom, 2 top, 3 inner side.
BoundaryMesh hollowCylinderMesh(double inner, double outer, double height, int around, int up);

/// Torus about the z axis.
BoundaryMesh torusMesh(double major, double minor, int nMajor, int nMinor);

}  // namespace palpa::bem::test
