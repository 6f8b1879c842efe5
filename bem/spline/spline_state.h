#pragma once

#include "bem/spline/spline_mesh.h"

namespace palpa::bem {

/// Tangents at a point of the mesh.
SurfaceTangents splineTangents(const SplineSurface& surface, const SplineMesh::Point& at);

/// Σ N_j c_j over the functions of an element, with 3 coefficients c_j each. `indices` are the
/// coefficients of the functions: SplineSurface::functions() for displacements,
/// SplineTractions::ofFunction for tractions.
Eigen::Vector3d splineValue(const SplineSurface& surface, const SplineMesh::Point& at,
                            const std::vector<int>& indices, const Eigen::VectorXd& coefficients);

}  // namespace palpa::bem
