#pragma once

#include <vector>

#include "bem/spline/spline_mesh.h"
#include "bem/spline/spline_surface.h"
#include "modeling/mesh/surface_mesh.h"
#include "modeling/solid/solid.h"
#include "modeling/solid/surface_evaluator.h"

namespace palpa::app {

/// A solid's patches as a surface of the spline discretisation, over the same control points.
bem::SplineSurface splineSurfaceOf(const modeling::Solid& solid);
/// As above; `smoothingGroups`: per patch, as modeling::smoothingGroups().
bem::SplineSurface splineSurfaceOf(const modeling::Solid& solid,
                                   const std::vector<int>& smoothingGroups);

/// Positions of the triangles of a solid's mesh on its patches, for a bem::SplineMesh. Knots may be
/// inserted into the solid before or after: parameters do not change. About 2 µs per triangle.
std::vector<bem::SplineMesh::Triangle> splineTriangles(const modeling::Solid& solid,
                                                       const modeling::SurfaceEvaluator& surface,
                                                       const modeling::SurfaceMesh& mesh);

}  // namespace palpa::app
