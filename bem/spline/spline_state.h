#pragma once

#include "bem/spline/spline_mesh.h"

namespace palpa::bem {

/// Tangents at a point of the mesh.
SurfaceTangents splineTangents(const SplineSurface& surface, const SplineMesh::Point& at);

/// Smallest weight with which results show tractions beside the border of a support, where they
/// are unbounded: at a hundredth of the border's width.
inline const double kMinWeight = CutBorder::weight(0.01);

/// Σ N_j c_j over the functions of an element, with 3 coefficients c_j each, of displacements.
/// `indices` are the coefficients of the functions.
Eigen::Vector3d splineValue(const SplineSurface& surface, const SplineMesh::Point& at,
                            const std::vector<int>& indices, const Eigen::VectorXd& coefficients);

/// The traction from the coefficients `p` of an element's slots.
Eigen::Vector3d splineTraction(const SplineSurface& surface, const SplineMesh::Point& at,
                               const std::vector<int>& slots, const Eigen::VectorXd& p);

}  // namespace palpa::bem
