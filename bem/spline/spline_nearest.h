#pragma once

#include "bem/spline/spline_collocation.h"
#include "bem/spline/spline_mesh.h"

namespace palpa::bem {

/// A point of the surface and its distance from the one that was asked about, mm.
struct SplineFoot {
  SplinePlace place;
  double distance;
};

/// The point of an element nearest to x, by Newton's method from the nearest of nine; exact for
/// points on the element and near it, otherwise perhaps a local minimum.
SplineFoot nearestOnElement(const SplineSurface& surface, int element, const Eigen::Vector3d& x);

/// A point of the surface as a collocation point: in all elements that contain it, its own first,
/// across the borders of patches too.
SplineCollocationPoint surfacePlaces(const SplineSurface& surface, const SplineMesh::Point& at);

}  // namespace palpa::bem
