#pragma once

#include <Eigen/Core>

#include "modeling/solid/solid.h"

// Solids made from a few lengths (mm). All have the patches side_xmin, side_xmax, side_ymin,
// side_ymax, bottom and top, one per face, and enough control points to be modelled further.
// Lengths must be finite and within kSmallestLength … kLargestLength; otherwise ModelingError.
namespace palpa::modeling {

inline constexpr double kSmallestLength = 1e-3;  // mm
inline constexpr double kLargestLength = 1e6;    // mm

/// Sphere around the origin: a cube whose six faces are mapped to the sphere by equal angles, so no
/// pole. Bicubic, `controlPoints` per direction and patch (4 … 64). The surface interpolates the
/// sphere; between, it deviates by up to 1.5e-4 of the radius for the default.
Solid makeSphere(double radius, int controlPoints = 7);

/// Cylinder with axis z from z = 0 to z = height. Four quarter sides (cubic around, cubic along z)
/// and two caps of one patch each, (√2 sin a cos b, √2 cos a sin b) R with a, b in [-π/4, π/4]:
/// its boundary is the circle at uniform angle and it has no pole; in exchange the derivatives are
/// parallel in the four corners. The rim deviates from the circle by less than 1e-4 R.
Solid makeCylinder(double radius, double height);

/// Box with the given edge lengths, centred in x and y, from z = 0 to z = size.z. Bicubic with 4 ×
/// 4 control points per face.
Solid makeBox(const Eigen::Vector3d& size);

}  // namespace palpa::modeling
