#pragma once

#include "modeling/shapes/make_primitive.h"

// The three most common solids by one call each: makePrimitive() with degree 3. They have the
// patches side_xmin, side_xmax, side_ymin, side_ymax, bottom and top. All throw ModelingError if a
// parameter is invalid.
namespace palpa::modeling {

/// Sphere around the origin: a cube whose six faces are mapped to the sphere by equal angles, so it
/// has no pole. `controlPoints` per direction and patch (4 … 64); with the default the deviation is
/// up to 1.5e-4 of the radius.
Solid makeSphere(double radius, int controlPoints = 7);

/// Cylinder with axis z from z = 0 to z = height: four quarter sides and two caps of one patch
/// each. The deviation of the rim from the circle is less than 1e-4 R.
Solid makeCylinder(double radius, double height);

/// Box with the given edge lengths, centred in x and y, from z = 0 to z = size.z.
Solid makeBox(const Eigen::Vector3d& size);

}  // namespace palpa::modeling
