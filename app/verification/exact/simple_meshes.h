#pragma once

#include <functional>

#include "bem/model/boundary_mesh.h"

/// Boundary meshes of simple bodies, for whatever is to be checked of bem/ without the modeller.
/// All nodes lie on the true surface; edge counts are the refinement parameter.
namespace palpa::verification {

/// Cube sphere of radius `radius` about the origin, `n` cells along each of the 12 cube edges (6
/// n^2 + 2 nodes).
bem::BoundaryMesh sphereMesh(double radius, int n);

/// Thick shell: outer sphere and inner sphere oriented towards the centre.
bem::BoundaryMesh hollowSphereMesh(double inner, double outer, int nInner, int nOuter);

/// Box with corners `low` and `high`; one smoothing group and tag per face in the order xmin, xmax,
/// ymin, ymax, zmin, zmax (tags 0 … 5).
bem::BoundaryMesh boxMesh(const Eigen::Vector3d& low, const Eigen::Vector3d& high, int nx, int ny,
                          int nz);

/// Cylinder about the z axis, base at z = 0: `around` cells around, `up` along, `radial` rings on
/// the caps. Groups and tags: 0 side, 1 bottom, 2 top.
bem::BoundaryMesh cylinderMesh(double radius, double height, int around, int up);

/// The same cylinder with cells that become smaller towards its edges (there about a quarter of the
/// mean size), for supports with singular stress at the edges.
bem::BoundaryMesh gradedCylinderMesh(double radius, double height, int around, int up);

/// Tube; groups and tags: 0 outer side, 1 bottom, 2 top, 3 inner side.
bem::BoundaryMesh hollowCylinderMesh(double inner, double outer, double height, int around, int up);

/// Torus about the z axis.
bem::BoundaryMesh torusMesh(double major, double minor, int nMajor, int nMinor);

}  // namespace palpa::verification
