#pragma once

#include <vector>

#include "bem/spline/spline_mesh.h"
#include "bem/spline/spline_surface.h"
#include "modeling/mesh/mesh.h"
#include "modeling/solid/solid.h"

namespace palpa::app {

/// A solid's patches in the terms of the spline discretisation, over the same control points.
bem::SplineSurface splineSurfaceOf(const modeling::Solid& solid);

/// Where the triangles of the solid's mesh are on its patches, for a bem::SplineMesh. Knots may be
/// inserted into the solid before or after: that does not change parameters. About 2 µs per
/// triangle.
std::vector<bem::SplineMesh::Triangle> splineTriangles(const modeling::Solid& solid,
                                                       const modeling::SurfaceMesh& mesh);

}  // namespace palpa::app
