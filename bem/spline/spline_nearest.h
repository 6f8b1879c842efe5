#pragma once

#include "bem/spline/spline_collocation.h"
#include "bem/spline/spline_mesh.h"
#include "bem/spline/spline_quadrature.h"

namespace palpa::bem {

/// Surface point and its distance from the query point, mm.
struct SplineFoot {
  SplinePlace place;
  double distance;
};

/// Point of an element nearest to x (mm), by Newton's method started from the nearest of nine
/// points. Exact for points on or near the element; otherwise possibly a local minimum.
SplineFoot nearestOnElement(const SplineSurface& surface, int element, const Eigen::Vector3d& x);

/// Surface point nearest to x (mm); for points far from the surface, one of the nearest.
SplineFoot nearestOnSurface(const SplineSurface& surface, const SplineQuadrature& quadrature,
                            const Eigen::Vector3d& x);

/// Surface point as a collocation point: its places in all elements that contain it, the element of
/// `at` first, across patch borders too.
SplineCollocationPoint surfacePlaces(const SplineSurface& surface, const SplineMesh::Point& at);

}  // namespace palpa::bem
