#pragma once

#include <functional>
#include <string>

#include "modeling/shapes/exact_shape.h"

// Surfaces of revolution around the z axis, in pieces without poles.
namespace palpa::modeling {

/// Division of circles. Quarters: four patches around the axis, centred on ±x and ±y, and one patch
/// over a disc. Eighths, for solids with an apex: eight patches around the axis, and four patches
/// over a disc that meet in its centre, where the basis `arc` begins.
struct RoundNet {
  bool eighths = false;
  SplineBasis arc;  ///< over 90°, or over the 45° from an axis to the diagonal
};

/// Adds the surface {point(radial, t)}, radial a horizontal unit vector, t from 0 to 1, with
/// outward normals on the right of growing t (seen in the plane of radial and z). Patches are named
/// `name`_xmin, …; `smoothStart` and `smoothEnd` tell whether the solid continues smoothly there.
void addBand(ExactShape& shape, const std::string& name, const RoundNet& net,
             const SplineBasis& along,
             const std::function<Eigen::Vector3d(const Eigen::Vector3d& radial, double t)>& point,
             bool smoothStart, bool smoothEnd);

/// Adds a surface over the unit disc. point() receives horizontal vectors of length 0 … 1/√2: the
/// disc scaled by 1/√2. The square [-π/4, π/4]² is mapped to it by (sin a cos b, cos a sin b): this
/// map has no pole, and the circle is its boundary at uniform angle, but the derivatives are
/// parallel in the square's four corners.
void addDisc(ExactShape& shape, const std::string& name, const RoundNet& net, bool facesUp,
             bool smoothRim,
             const std::function<Eigen::Vector3d(const Eigen::Vector3d& flat)>& point);

/// Adds a flat disc; `rim` is (radius, z), mm.
void addFlatDisc(ExactShape& shape, const std::string& name, const RoundNet& net, bool facesUp,
                 bool smoothRim, const Eigen::Vector2d& rim);

}  // namespace palpa::modeling
