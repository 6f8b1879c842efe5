#pragma once

#include "bem/spline/spline_collocation.h"
#include "bem/spline/spline_mesh.h"

namespace palpa::bem {

/// Point of an element nearest to x (mm), by Newton's method started from the nearest of nine
/// points. Exact for points on or near the element; otherwise possibly a local minimum.
ElementFoot nearestOnElement(const SplineSurface& surface, int element, const Eigen::Vector3d& x);

/// Surface point as a collocation point: its places in all elements that contain it, the element of
/// `at` first, across patch borders too.
CollocationPlace surfacePlaces(const SplineSurface& surface, const SplineMesh::Point& at);

}  // namespace palpa::bem
