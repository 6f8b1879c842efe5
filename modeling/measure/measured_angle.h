#pragma once

#include <vector>

#include "modeling/measure/measured_surface.h"

// Angles of measurements. Internal to modeling/measure.
namespace palpa::modeling {

/// Angle of two faces, two edges, or an edge and a face, rad in [0, π], or at the second of three
/// points. Of faces: through the material. Of edges: away from a common end, else the smaller
/// angle between their tangents. Of an edge and a face: between the tangent and the tangent plane,
/// at most π/2. Throws ModelingError if a place is gone, or if two of three points are at one
/// place.
MeasuredValue angleOf(const MeasuredSurface& surface, const std::vector<MeasuredPlace>& places);

}  // namespace palpa::modeling
