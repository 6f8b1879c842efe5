#pragma once

#include "bem/model/material.h"
#include "bem/spline/spline_mesh.h"

namespace palpa::bem {

/// Orthonormal tangents and outward normal of the surface near a place, and the slopes of the
/// element's functions along the tangents. Where the surface has no metric (the corner of a round
/// cap, a collapsed edge) they are those a little inside the element.
struct SplineTangents {
  Eigen::Vector3d position;  ///< mm, where they are taken
  Eigen::Matrix3d frame;     ///< columns: two tangents, the normal
  std::vector<double> values;
  Eigen::Matrix2Xd slopes;  ///< a column per function of the element, 1/mm
};
SplineTangents splineTangents(const SplineSurface& surface, const SplineMesh::Point& at);

/// Σ N_j c_j of the functions of an element with 3 coefficients each, by their indices: of
/// displacements SplineSurface::functions(), of tractions SplineTractions::ofFunction.
Eigen::Vector3d splineValue(const SplineSurface& surface, const SplineMesh::Point& at,
                            const std::vector<int>& indices, const Eigen::VectorXd& coefficients);

/// Displacement, its gradient (column j is the derivative along axis j) and Cauchy stress on the
/// surface: tangential derivatives are those of u, the others follow from the traction by Hooke's
/// law, regular at nu = 0.5.
struct SplineSurfaceState {
  Eigen::Vector3d position, displacement;
  Eigen::Matrix3d gradient, stress;
};
SplineSurfaceState splineSurfaceState(const SplineSurface& surface,
                                      const SplineTractions& tractions, const SplineMesh::Point& at,
                                      const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                                      const Material& material);

}  // namespace palpa::bem
