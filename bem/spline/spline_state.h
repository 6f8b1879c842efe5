#pragma once

#include "bem/model/material.h"
#include "bem/spline/spline_mesh.h"

namespace palpa::bem {

/// Orthonormal tangents and outward normal of the surface near a place, and the derivatives of the
/// element's functions along the tangents. Where the surface metric is singular (the corner of a
/// round cap, a collapsed edge) they are evaluated slightly inside the element.
struct SplineTangents {
  Eigen::Vector3d position;  ///< mm, where they are evaluated
  Eigen::Matrix3d frame;     ///< columns: two tangents, the normal
  std::vector<double> values;
  Eigen::Matrix2Xd slopes;  ///< one column per function of the element, 1/mm
};
SplineTangents splineTangents(const SplineSurface& surface, const SplineMesh::Point& at);

/// Σ N_j c_j over the functions of an element, with 3 coefficients c_j each. `indices` are the
/// coefficients of the functions: SplineSurface::functions() for displacements,
/// SplineTractions::ofFunction for tractions.
Eigen::Vector3d splineValue(const SplineSurface& surface, const SplineMesh::Point& at,
                            const std::vector<int>& indices, const Eigen::VectorXd& coefficients);

/// Displacement (mm), its gradient (column j is the derivative along axis j) and Cauchy stress
/// (MPa) on the surface. Tangential derivatives come from u; the others follow from the traction by
/// Hooke's law, which is regular at nu = 0.5.
struct SplineSurfaceState {
  Eigen::Vector3d position, displacement;
  Eigen::Matrix3d gradient, stress;
};
SplineSurfaceState splineSurfaceState(const SplineSurface& surface,
                                      const SplineTractions& tractions, const SplineMesh::Point& at,
                                      const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                                      const Material& material);

}  // namespace palpa::bem
